// Pixel buffer groups: the pixel buffers of a source's private contexts, each group made when it is first
// asked for.
#pragma once

#include <functional>
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
  /// The buffers of `own`, which is current, for a read in `way`: null where none are wanted or to be had.
  /// For the first asynchronous read `make_twin` makes a context that shares with it, which `reader` tries
  /// out.
  std::shared_ptr<PixelBuffers> of_context(const void* own, ReadWay way, const GlFunctions& gl,
                                           const void* display, LateReader& reader,
                                           const MakeTwin& make_twin);
  /// The context goes. Null if it has no buffers.
  std::shared_ptr<PixelBuffers> take(const void* context);
  std::vector<std::shared_ptr<PixelBuffers>> of_display(const void* display);

 private:
  std::shared_ptr<PixelBuffers> find(const void* context);
  struct Entry {
    const void* context;
    std::shared_ptr<PixelBuffers> buffers;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

/// Lets the reader delete the buffers that are not in use. Does not wait.
void trim_later(const std::vector<std::shared_ptr<PixelBuffers>>& groups, LateReader& reader);

}  // namespace tilepress
