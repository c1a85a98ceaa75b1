// Context pool: the shim's own contexts, one per display and config, more where threads present at the same
// time.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

namespace tilepress {

/// Contexts that are current on no thread. Never destroys one: at the end of a process GL must not be called,
/// and before it the contexts are in use.
class ContextPool {
 public:
  struct Key {
    const void* display;
    uintptr_t config;
    bool operator==(const Key&) const = default;
  };
  /// A free context for `key`, which is the caller's until give(); null if there is none.
  void* take(const Key& key) {
    std::lock_guard lock(mutex_);
    for (Entry& entry : entries_)
      if (entry.key == key) {
        void* context = entry.context;
        entry = entries_.back();
        entries_.pop_back();
        return context;
      }
    return nullptr;
  }
  void give(const Key& key, void* context) {
    std::lock_guard lock(mutex_);
    entries_.push_back({key, context});
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
