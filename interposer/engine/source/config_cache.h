// Config cache: the framebuffer configs seen so far. To find a config by its number, a driver sorts all of
// them.
#pragma once

#include <compare>
#include <map>
#include <mutex>
#include <optional>

#include "tilepress/pixel_format.h"

namespace tilepress {

struct KnownConfig {
  void* config = nullptr;             ///< EGLConfig or GLXFBConfig, valid as long as the display
  std::optional<PixelFormat> format;  ///< empty: no format has these channels
  bool multisampled = false;          ///< a read must resolve it first
  bool double_buffered = true;        ///< GLX only: EGL has this per surface
  bool srgb_capable = false;          ///< GLX only
};

/// By display, config number and screen number. Thread-safe.
class ConfigCache {
 public:
  struct Key {
    const void* display;
    int id, screen;
    auto operator<=>(const Key&) const = default;
  };
  /// Returns the config of `key`. Calls `query` for it until `query` returns one.
  template <typename Query>
  std::optional<KnownConfig> find(const Key& key, const Query& query) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = configs_.find(key); known != configs_.end()) return known->second;
    }
    const std::optional<KnownConfig> found = query();
    const std::lock_guard lock(mutex_);
    if (found) configs_.emplace(key, *found);
    return found;
  }
  /// The display ends. Its configs and their numbers may mean something else afterwards.
  void forget(const void* display) {
    const std::lock_guard lock(mutex_);
    std::erase_if(configs_, [&](const auto& entry) { return entry.first.display == display; });
  }

 private:
  std::mutex mutex_;
  std::map<Key, KnownConfig> configs_;
};

}  // namespace tilepress
