// Memory request: one line of a memory trace.
#pragma once

#include <cstdint>
#include <span>

#include "tilepress/surface_reader.h"

namespace tilepress {

struct MemoryRequest {
  uint64_t time_ps = 0;
  uint64_t address = 0;  ///< bytes; a multiple of `bytes`
  uint32_t bytes = 0;
  bool write = false;
  SurfacePart part = SurfacePart::kPayload;
  uint32_t surface = 0;
  uint64_t frame = 0;
  std::span<const uint8_t> content;  ///< `bytes` bytes, or none
};

/// Takes the requests of a trace in the order of their times.
class RequestSink {
 public:
  virtual ~RequestSink() = default;
  virtual Result<void> take(const MemoryRequest& request) = 0;
};

}  // namespace tilepress
