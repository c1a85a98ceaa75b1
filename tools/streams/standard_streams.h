// Standard streams: closed, full and broken standard streams, handled in one place for all verbs.
#pragma once

#include "tilepress/result.h"

namespace tilepress {

/// Call first in main. From then on
/// - a failed write to standard output is noted, whichever stdio function made it;
/// - SIGPIPE is ignored, so that a write to a closed pipe fails and does not end the process;
/// - no file gets the number of a standard stream that the caller closed. Programs that tilepress starts
///   still find the stream closed.
void guard_standard_streams();

/// Restores what SIGPIPE does by the choice of the caller. Call between fork and exec; async-signal-safe.
void restore_sigpipe();

/// Writes out what is buffered for standard output. Fails if any write to standard output has failed since
/// the start.
Result<void> flush_standard_output();
/// Whether flush_standard_output() has failed before.
bool standard_output_has_failed();

/// Keeps image libraries from printing the errors that they also return: standard error leads nowhere while
/// any of these objects lives, in any thread.
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
