// Rendering: how a trace is rendered into the cache folder, and what came of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "tilepress/trace_replay.h"

namespace tilepress {

struct RenderOptions {
  std::string cache_folder;  ///< empty: default_cache_folder()
  /// Bytes of all cache files. The least recently used ones go when a rendering has ended; those used
  /// within the last hour stay.
  uint64_t size_limit_bytes = uint64_t{20} << 30;
  RetracerChoice retracer = RetracerChoice::kAuto;
  ReplayDisplay display = ReplayDisplay::kAuto;
  std::chrono::seconds timeout{300};
  std::string shim;  ///< see ReplayOptions
  /// Frames rendered so far, and frames wanted once known. Called from the calling thread.
  std::function<void(uint64_t, std::optional<uint64_t>)> progress;
};

struct CachedRendering {
  std::string path;       ///< of the cache file
  bool rendered = false;  ///< by this call
  double seconds = 0;     ///< time of the rendering
  std::string reason;     ///< why frames are missing; empty if all are there
};

}  // namespace tilepress
