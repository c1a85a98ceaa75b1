// Trace fault: why reading a trace stopped before its end.
#pragma once

#include <string>

#include "tilepress/trace_summary.h"

namespace tilepress {

/// Thrown inside the trace reader and caught by summarize_trace(); never leaves replay/.
struct TraceFault {
  TraceState state;  ///< kTruncated or kCorrupt
  std::string reason;
};

[[noreturn]] inline void fail_corrupt(std::string reason) {
  throw TraceFault{TraceState::kCorrupt, std::move(reason)};
}

}  // namespace tilepress
