// Context pool: the shim's own contexts, one per display and config, and more if threads present at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

namespace tilepress {

/// Contexts that are current on no thread. The pool destroys none: at the end of a process GL must not be
/// called.
class ContextPool {
 public:
  struct Key {
    const void* display;
    uintptr_t config;
    bool operator==(const Key&) const = default;
  };
  /// Returns a free context for `key`, or null. The caller owns the context until give().
  void* take(const Key& key) {
    std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    if (found == entries_.end()) return nullptr;
    void* context = found->context;
    entries_.erase(found);
    return context;
  }
  void give(const Key& key, void* context) {
    std::lock_guard lock(mutex_);
    entries_.push_back({key, context});
  }
  /// Takes out all free contexts of `display`.
  std::vector<void*> take_all(const void* display) {
    std::lock_guard lock(mutex_);
    std::vector<void*> taken;
    std::erase_if(entries_, [&](const Entry& entry) {
      if (entry.key.display != display) return false;
      taken.push_back(entry.context);
      return true;
    });
    return taken;
  }

 private:
  struct Entry {
    Key key;
    void* context;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace tilepress
