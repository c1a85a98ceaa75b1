// Trace fault: why the trace reader stopped before the end of a trace.
#pragma once

#include <string>

#include "tilepress/trace_summary.h"

namespace tilepress {

/// Thrown by the parts of the trace reader, at any depth, and caught by its public functions, which return it
/// as the summary's state.
struct TraceFault {
  TraceState state;  ///< kTruncated or kCorrupt
  std::string reason;
};

[[noreturn]] inline void fail_corrupt(std::string reason) {
  throw TraceFault{TraceState::kCorrupt, std::move(reason)};
}
[[noreturn]] inline void fail_truncated(std::string reason) {
  throw TraceFault{TraceState::kTruncated, std::move(reason)};
}

}  // namespace tilepress
