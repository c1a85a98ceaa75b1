// Cached rendering: the frames of a trace from the cache folder, rendered at the first request only.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "tilepress/result.h"
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

/// Returns the cache file with the frames of a trace: all of them, or those of input.frames. Renders the
/// trace if the folder has no whole file of this format for it. Several processes, on several hosts too, may
/// call this for one folder: one renders, the others wait for its file. A torn, foreign, older or newer file
/// is reported in one line and replaced. A file that lacks frames is whole, too. Errors, one line that begins
/// with the trace:
///   kUnsupported  all frames have a format that is not modelled
///   kSystem       `stop` became nonzero, or there is no renderer
///   kFile         the trace cannot be read or rendered (nothing was captured), or the folder cannot be
///   written
Result<CachedRendering> find_or_render(const ReplayInput& input, const RenderOptions& options,
                                       const std::atomic<int>& stop);

/// Returns the path of the cache file if the folder has the frames, and no path if the trace would be
/// rendered. Renders nothing. Error: the trace cannot be read.
Result<std::optional<std::string>> find_rendered(const ReplayInput& input, const RenderOptions& options);

}  // namespace tilepress
