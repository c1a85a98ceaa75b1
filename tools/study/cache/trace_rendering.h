// Trace rendering: replays a trace once, and packs its frames while the replay goes on.
#pragma once

#include <atomic>
#include <string>

#include "study/cache/cache_key.h"

namespace tilepress {

/// Renders the trace into the cache file `path`. Dumped frames lie in a temporary folder until they are
/// packed. A trace of which only some frames were captured leaves a file with a reason. Errors, the trace
/// first: nothing was captured, a file cannot be written, `stop` became nonzero.
Result<CachedRendering> render_trace(const ReplayInput& input, const RenderOptions& options,
                                     const CacheKey& key, const std::string& path,
                                     const std::atomic<int>& stop);

}  // namespace tilepress
