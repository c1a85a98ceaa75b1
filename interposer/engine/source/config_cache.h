// Config cache: what a framebuffer config is, asked of the driver once: choosing one by its number sorts them
// all.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "tilepress/pixel_format.h"

namespace tilepress {

struct KnownConfig {
  void* config = nullptr;             ///< EGLConfig or GLXFBConfig; good as long as the display
  std::optional<PixelFormat> format;  ///< empty: its channels fit none
  bool multisampled = false;          ///< not to be read without a resolve
  bool double_buffered = true;        ///< GLX; of an EGL surface it is the surface that knows
  bool srgb_capable = false;          ///< GLX, as is this
};

/// By display and number (of config, and of screen where numbers are per screen). Thread-safe.
class ConfigCache {
 public:
  struct Key {
    const void* display;
    int id, screen;
    bool operator==(const Key&) const = default;
  };
  /// The config of `key`; `ask` gives it, or nothing, the first time.
  template <typename Ask>
  std::optional<KnownConfig> find(const Key& key, const Ask& ask) {
    {
      const std::lock_guard lock(mutex_);
      for (const Entry& entry : entries_)
        if (entry.key == key) return entry.config;
    }
    const std::optional<KnownConfig> found = ask();
    const std::lock_guard lock(mutex_);
    if (found) entries_.push_back({key, *found});
    return found;
  }
  /// The display ends: its configs and their numbers may mean something else afterwards.
  void forget(const void* display) {
    const std::lock_guard lock(mutex_);
    std::erase_if(entries_, [&](const Entry& entry) { return entry.key.display == display; });
  }

 private:
  struct Entry {
    Key key;
    KnownConfig config;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace tilepress
