// Standard streams: what a caller that closes or fills them meets, at one place for all verbs.
#pragma once

#include <string>

namespace tilepress {

/// Call first in main. From then on
/// - a failed write to standard output is noted, whichever stdio function made it;
/// - SIGPIPE is ignored, so that a closed pipe is a failed write and not a death without a word;
/// - no file gets the number of a standard stream that the caller closed. Programs that we start still find
///   it closed.
void guard_standard_streams();

/// Gives SIGPIPE the meaning that the caller chose. Call between fork and exec; async-signal-safe.
void restore_sigpipe();

/// Writes out what is buffered for standard output. Returns false if standard output did not take everything
/// since the start; `error` is then one line, or empty if an earlier call returned it.
bool flush_standard_output(std::string& error);

}  // namespace tilepress
