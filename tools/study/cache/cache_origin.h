// Cache origin: where the frames of a cache file come from, as JSON inside the file.
#pragma once

#include <string>
#include <string_view>

#include "study/cache/frame_cache.h"

namespace tilepress {

std::string origin_text(const CacheOrigin& origin);
/// Unknown members are skipped, missing ones stay empty. Error: kBadBits.
Result<CacheOrigin> parse_origin(std::string_view text);

}  // namespace tilepress
