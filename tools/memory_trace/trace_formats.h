// Trace formats: how a request is written for each simulator.
#pragma once

#include <memory>
#include <string>

#include "memory_trace/memory_request.h"
#include "memory_trace/trace_options.h"

namespace tilepress {

/// The text or the bytes of one format.
class TraceFormatter {
 public:
  virtual ~TraceFormatter() = default;
  /// What comes before the first request.
  virtual void begin(std::string&) {}
  virtual void append(const MemoryRequest& request, std::string& out) = 0;
};

/// `options.format` is set. `request_bytes`: of every request.
std::unique_ptr<TraceFormatter> make_trace_formatter(const MemoryTraceOptions& options, uint32_t request_bytes);

/// gem5's packet trace (gem5_packet.proto).
std::unique_ptr<TraceFormatter> make_gem5_formatter();

}  // namespace tilepress
