// Memory trace: the requests of one scheme, in a simulator's format.
#pragma once

#include <cstdint>
#include <string>

#include "memory_trace/request_timeline.h"
#include "memory_trace/trace_file.h"
#include "memory_trace/trace_formats.h"

namespace tilepress {

/// What a trace holds.
struct TraceTotals {
  uint64_t frames = 0;
  uint64_t reads = 0, writes = 0;  ///< requests
  uint64_t requests() const { return reads + writes; }
};

/// Writes one trace.
class MemoryTrace : private RequestSink {
 public:
  /// Opens `path`. The options are settled, and `burst_bits` is the burst of every frame.
  Result<void> open(const std::string& path, const MemoryTraceOptions& options, uint32_t burst_bits);
  /// Where the frames' accesses go in. Precondition: open() succeeded.
  RequestTimeline& timeline() { return *timeline_; }
  /// Writes what is left and gives the file its name.
  Result<void> finish();
  TraceTotals& totals() { return totals_; }
  /// "trace.csv: 30 frames, 5000 writes and 4000 reads of 16 bytes".
  std::string summary() const;

 private:
  Result<void> take(const MemoryRequest& request) override;
  void flush();

  std::string path_;
  TraceFile file_;
  RequestShape shape_;
  std::unique_ptr<TraceFormatter> formatter_;
  std::unique_ptr<RequestTimeline> timeline_;
  std::string buffer_;
  TraceTotals totals_;
};

constexpr uint64_t kPicosecondsPerSecond = 1'000'000'000'000;

/// The time of one frame at `refresh_hz`, in picoseconds.
inline uint64_t frame_period_ps(double refresh_hz) {
  return static_cast<uint64_t>(static_cast<double>(kPicosecondsPerSecond) / refresh_hz);
}

}  // namespace tilepress
