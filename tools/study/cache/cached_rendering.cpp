// Cached rendering: looks for the file of the key, takes the lock, looks again, renders.
#include "study/cache/cached_rendering.h"

#include <spdlog/spdlog.h>

#include <filesystem>

#include "streams/messages.h"
#include "study/cache/cache_folder.h"
#include "study/cache/cache_key.h"
#include "study/cache/cache_lock.h"
#include "study/cache/frame_cache.h"
#include "study/cache/trace_rendering.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const RenderOptions& options) {
  return options.cache_folder.empty() ? default_cache_folder() : options.cache_folder;
}

/// The rendering in the file, if it is one of this key. A file that is something else is reported.
std::optional<CachedRendering> look(const std::string& path, const std::string& key, bool report) {
  std::error_code code;
  if (!fs::exists(path, code)) return std::nullopt;
  FrameCacheReader reader;
  auto opened = reader.open(path);
  if (opened && reader.origin().key != key)
    opened = Error{ErrorKind::kBadBits, path + ": holds the frames of another trace or renderer"};
  if (!opened) {
    if (report) say(MessageLevel::kWarning, opened.error().text + "; rendered again");
    return std::nullopt;
  }
  note_use(path);
  return CachedRendering{.path = path, .reason = reader.origin().reason};
}

}  // namespace

Result<CachedRendering> find_or_render(const ReplayInput& input, const RenderOptions& options,
                                       const std::atomic<int>& stop) {
  const auto key = cache_key(input, options);
  if (!key) return key.error();
  const std::string folder = folder_of(options), path = cache_path(folder, key->key);
  // A damaged file is reported by the process that replaces it.
  if (const auto found = look(path, key->key, false)) return *found;
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return Error{ErrorKind::kFile, folder + ": " + code.message()};
  CacheLock lock;
  bool waited = false;
  const auto taken = lock.take(path + ".lock", [&] {
    if (!waited) spdlog::info("{}: waits for another process that renders it", input.path);
    waited = true;
    return stop != 0;
  });
  if (!taken) return about(input.path, taken.error());
  if (!*taken) return Error{ErrorKind::kSystem, input.path + ": interrupted"};
  if (const auto found = look(path, key->key, true)) return *found;
  const auto rendered = render_trace(input, options, *key, path, stop);
  if (!rendered) return rendered.error();
  apply_size_limit(folder, options.size_limit_bytes);
  return rendered;
}

Result<std::optional<std::string>> find_rendered(const ReplayInput& input, const RenderOptions& options) {
  const auto key = cache_key(input, options);
  if (!key) return key.error();
  const auto found = look(cache_path(folder_of(options), key->key), key->key, false);
  return found ? std::optional(found->path) : std::nullopt;
}

}  // namespace tilepress
