// Request timeline: turns accesses into requests, and orders those of several streams by time.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "memory_trace/memory_map.h"
#include "memory_trace/memory_request.h"
#include "tilepress/compressed_surface.h"

namespace tilepress {

/// The accesses of one frame in one direction, spread evenly over the time from `begin_ps` to `end_ps`.
struct AccessStream {
  uint64_t frame = 0;
  uint32_t surface = 0;
  bool write = false;
  uint64_t begin_ps = 0, end_ps = 0;
  SurfacePlace place;
  std::vector<MemoryFetch> accesses;
  std::shared_ptr<const CompressedSurface> stored;  ///< for the content of requests; null = none
};

/// Bursts of `burst_bytes` become requests of `request_bytes`, a multiple of a burst: bursts that follow each
/// other in one aligned piece of `request_bytes` of one part are one request.
struct RequestShape {
  uint32_t burst_bytes = 16;
  uint32_t request_bytes = 16;
};

/// Requests of equal time go in the order in which their streams were added.
class RequestTimeline {
 public:
  RequestTimeline(const RequestShape& shape, RequestSink& sink);
  ~RequestTimeline();
  /// Precondition: no request at or after stream.begin_ps has been given to the sink.
  void add(AccessStream stream);
  /// Gives the sink all requests before `time_ps`.
  Result<void> advance_to(uint64_t time_ps);
  /// Gives the sink all other requests.
  Result<void> finish() { return advance_to(UINT64_MAX); }

 private:
  class Stream;
  RequestShape shape_;
  RequestSink& sink_;
  std::vector<std::unique_ptr<Stream>> streams_;  ///< those with requests left, in the order added
};

}  // namespace tilepress
