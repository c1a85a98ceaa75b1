// Frame feed: the frames of a workload in the order in which they were presented.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/surface.h"

namespace tilepress {

struct FedFrame {
  uint64_t frame = 0;    ///< number of the frame on its surface
  uint32_t surface = 0;  ///< a surface has one size and format
  uint64_t time_ns = 0, readback_ns = 0;
  SurfaceView view;  ///< valid until the next call
};

/// Not thread-safe.
class FrameFeed {
 public:
  virtual ~FrameFeed() = default;
  /// Returns false after the last frame. Error texts begin with the file.
  virtual Result<bool> next(FedFrame& out) = 0;
};

/// Opens a feed at its first frame. Any thread may call it.
using OpenFeed = std::function<Result<std::unique_ptr<FrameFeed>>()>;

/// Images, one movie or one animation.
OpenFeed image_feed(const std::vector<std::string>& paths);
/// A frame cache file.
OpenFeed cache_feed(const std::string& path);

}  // namespace tilepress
