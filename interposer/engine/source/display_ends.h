// Display ends: forgets the contexts and configs kept for an X display when the program closes it.
#pragma once

#include <X11/Xlib.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "interposer/engine/source/config_cache.h"
#include "interposer/engine/readback/context_pool.h"

namespace tilepress {

/// A closed display's address may come back as another display, and its GLX contexts died with it.
class DisplayEnds {
 public:
  static DisplayEnds& instance() {
    static auto* const ends = new DisplayEnds;  // outlives everything
    return *ends;
  }
  /// `end` may be null; it is told which contexts of the pool go with the display.
  using End = std::function<void(const void* display, const std::vector<void*>& contexts)>;
  void add(ContextPool* pool, ConfigCache* configs, End end) {
    std::lock_guard lock(mutex_);
    keepers_.push_back({pool, configs, std::move(end)});
  }
  /// True the first time for `display`.
  bool watch(Display* display) {
    std::lock_guard lock(mutex_);
    if (std::find(watched_.begin(), watched_.end(), display) != watched_.end()) return false;
    watched_.push_back(display);
    return true;
  }
  /// To be registered with XESetCloseDisplay.
  static int on_close(Display* display, XExtCodes*) {
    DisplayEnds& ends = instance();
    std::lock_guard lock(ends.mutex_);
    std::erase(ends.watched_, display);
    for (const Keeper& keeper : ends.keepers_) {
      const std::vector<void*> contexts = keeper.pool->take_all(display);
      if (keeper.end) keeper.end(display, contexts);
      keeper.configs->forget(display);
    }
    return 0;
  }

 private:
  std::mutex mutex_;
  struct Keeper {
    ContextPool* pool;
    ConfigCache* configs;
    End end;
  };
  std::vector<Keeper> keepers_;
  std::vector<Display*> watched_;
};

}  // namespace tilepress
