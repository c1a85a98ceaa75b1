// Composed trace: the memory trace of showing several packed surfaces at once.
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "frames/composition.h"
#include "frames/packed_reader.h"
#include "memory_trace/memory_trace.h"

namespace tilepress {

/// The reads of each frame fill the time of one refresh, those of its surfaces beside each other.
class ComposedTrace {
 public:
  /// Places each surface of each file and opens the trace. Error: kUnsupported if the bursts of the files
  /// differ; texts name the file.
  Result<void> open(const MemoryTraceOptions& options, const std::vector<std::unique_ptr<PackedFile>>& files,
                    double refresh_hz);
  /// Adds the reads of a frame. `reads`: one per layer, with fetches.
  Result<void> add(uint64_t frame, const std::vector<Layer>& layers, const std::vector<LayerTraffic>& reads);
  /// Returns a line about the trace.
  Result<std::string> finish();

 private:
  /// File, width, height, format: surfaces that are the same place in memory.
  using SurfaceKey = std::tuple<size_t, uint32_t, uint32_t, PixelFormat>;
  static SurfaceKey key_of(size_t file, const CompressedSurface& surface) {
    return {file, surface.width, surface.height, surface.format};
  }
  /// The accesses that fetches stand for.
  std::vector<MemoryFetch> accesses_of(const CompressedSurface& surface, const std::vector<MemoryFetch>& fetches) const;

  MemoryTraceOptions options_;
  uint64_t period_ps_ = 0;
  std::map<SurfaceKey, uint32_t> numbers_;
  MemoryMap map_{0};
  MemoryTrace trace_;
};

}  // namespace tilepress
