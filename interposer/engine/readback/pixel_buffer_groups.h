// Pixel buffer groups: the pixel buffers of a source's private contexts. The first use of a context makes its
// group.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/readback/pixel_buffers.h"

namespace tilepress {

/// By private context. Thread-safe.
class PixelBufferGroups {
 public:
  using MakeTwin = std::function<bool(TwinContext& twin)>;
  /// Returns the buffers of `own`, which is current, for a read in `way`, or null if the way needs none or
  /// there are none. Before the first asynchronous read, `make_twin` makes a context that shares with `own`,
  /// and `reader` tries it out.
  std::shared_ptr<PixelBuffers> of_context(const void* own, ReadWay way, const GlFunctions& gl,
                                           const void* display, LateReader& reader,
                                           const MakeTwin& make_twin);
  /// Takes out the buffers of a context that goes. Returns null if it has none.
  std::shared_ptr<PixelBuffers> take(const void* context);
  std::vector<std::shared_ptr<PixelBuffers>> of_display(const void* display);

 private:
  std::mutex mutex_;
  std::map<const void*, std::shared_ptr<PixelBuffers>> groups_;  ///< by context
};

/// Makes the reader delete the buffers that are not in use. Does not wait.
void trim_later(const std::vector<std::shared_ptr<PixelBuffers>>& groups, LateReader& reader);

}  // namespace tilepress
