// Quiet standard error: keeps image libraries from printing there what they also report.
#pragma once

namespace tilepress {

/// Takes standard error away while any of these lives, in any thread.
class QuietStandardError {
 public:
  QuietStandardError();
  ~QuietStandardError();
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;
};

/// The descriptor that leads to the true standard error, quiet or not. Async-signal-safe.
int true_standard_error();

}  // namespace tilepress
