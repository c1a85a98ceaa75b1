// Cached surface: counts the frames of each surface.
#include "frames/cached_surface.h"

#include <array>
#include <cstdio>
#include <map>

#include "counted.h"

namespace tilepress {

bool is_frame_cache(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rbe");
  if (file == nullptr) return false;
  std::array<std::byte, kFrameCacheMagicBytes> start{};
  const size_t got = std::fread(start.data(), 1, start.size(), file);
  std::fclose(file);
  return begins_as_frame_cache(std::span(start).first(got));
}

Result<CachedSurface> largest_cached_surface(const std::string& path) {
  auto cache = std::make_shared<FrameCacheReader>();
  if (const auto opened = cache->open(path); !opened) {
    Error error = opened.error();
    if (error.text.starts_with(path + ": ")) error.text.erase(0, path.size() + 2);
    return error;
  }
  std::map<uint32_t, std::vector<uint32_t>> surfaces;
  for (uint64_t i = 0; i < cache->frame_count(); ++i)
    surfaces[cache->header(i).surface].push_back(static_cast<uint32_t>(i));
  const std::vector<uint32_t>* most = nullptr;
  for (const auto& [surface, frames] : surfaces)
    if (most == nullptr || frames.size() > most->size()) most = &frames;
  if (most == nullptr) return Error{ErrorKind::kUnsupported, "holds no frame"};
  const CachedFrame& first = cache->header(most->front());
  if (!traits(first.format).modelled)
    return Error{ErrorKind::kUnsupported,
                 "is " + std::string(traits(first.format).name) + ", which is not modelled"};
  CachedSurface out{cache, first.width, first.height, first.format, *most, ""};
  if (surfaces.size() > 1)
    out.left_out = "surface " + std::to_string(first.surface) + " is taken; " +
                   counted(surfaces.size() - 1, "further surface") + " with " +
                   counted(cache->frame_count() - most->size(), "frame") + " left out";
  return out;
}

}  // namespace tilepress
