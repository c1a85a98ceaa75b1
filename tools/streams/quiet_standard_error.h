// Quiet standard error: keeps image libraries from printing the errors that they also return.
#pragma once

namespace tilepress {

/// Standard error leads nowhere while any of these objects lives, in any thread.
class QuietStandardError {
 public:
  QuietStandardError();
  ~QuietStandardError();
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;
};

/// The descriptor of the true standard error, whether it is quiet or not. Async-signal-safe.
int true_standard_error();

}  // namespace tilepress
