// Cached rendering: the frames of a trace from the cache folder, rendered at the first request only.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "study/cache/rendering.h"
#include "tilepress/result.h"

namespace tilepress {

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
