// Memory trace: requests through a formatter into a file.
#include "memory_trace/memory_trace.h"

#include <fmt/format.h>

#include "counted.h"

namespace tilepress {

constexpr size_t kPieceBytes = 1 << 16;

Result<void> MemoryTrace::open(const std::string& path, const MemoryTraceOptions& options, uint32_t burst_bits) {
  path_ = path;
  const auto request_bytes = request_bytes_for(options, burst_bits);
  if (!request_bytes) return request_bytes.error();
  shape_ = {burst_bits / 8, *request_bytes};
  if (const auto opened = file_.open(path, options.force); !opened) return opened;
  formatter_ = make_trace_formatter(options, *request_bytes);
  RequestSink& sink = *this;
  timeline_ = std::make_unique<RequestTimeline>(shape_, sink);
  formatter_->begin(buffer_);
  return {};
}

Result<void> MemoryTrace::take(const MemoryRequest& request) {
  ++(request.write ? totals_.writes : totals_.reads);
  formatter_->append(request, buffer_);
  if (buffer_.size() >= kPieceBytes) flush();
  return {};
}

void MemoryTrace::flush() {
  file_.write(buffer_);
  buffer_.clear();
}

Result<void> MemoryTrace::finish() {
  if (const auto finished = timeline_->finish(); !finished) return finished;
  flush();
  return file_.commit();
}

std::string MemoryTrace::summary() const {
  return fmt::format("{}: {}, {} and {} of {}\n", path_, counted(totals_.frames, "frame"),
                     counted(totals_.writes, "write"), counted(totals_.reads, "read"),
                     counted(shape_.request_bytes, "byte"));
}

}  // namespace tilepress
