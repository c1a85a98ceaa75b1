// Cached rendering: not built in yet.
#include "study/cache/cache_commands.h"
#include "study/cache/cached_rendering.h"

namespace tilepress {
namespace {
const Error kPending{ErrorKind::kUnsupported, "traces cannot be studied yet"};
}
Result<CachedRendering> find_or_render(const ReplayInput& input, const RenderOptions&, const std::atomic<int>&) {
  return about(input.path, kPending);
}
Result<std::optional<std::string>> find_rendered(const ReplayInput&, const RenderOptions&) {
  return std::optional<std::string>();
}
int list_cache(const std::string&) { return 1; }
int prune_cache(const std::string&, const PruneOptions&) { return 1; }
}  // namespace tilepress
