// Frame feed: the frames of a workload in the order in which they were presented.
#pragma once

#include <cstdint>
#include <functional>
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

/// Reads the next frame. Returns false after the last frame. Error texts begin with the file. Not
/// thread-safe.
using FrameFeed = std::function<Result<bool>(FedFrame& out)>;

/// Opens a feed at its first frame. Any thread may call it.
using OpenFeed = std::function<Result<FrameFeed>()>;

/// Images, one movie or one animation.
OpenFeed image_feed(const std::vector<std::string>& paths);
/// A frame cache file.
OpenFeed cache_feed(const std::string& path);

}  // namespace tilepress
