// Display ends: forgets the contexts and configs kept for an X display when the program closes it.
#pragma once

#include <X11/Xlib.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "interposer/engine/config_cache.h"
#include "interposer/engine/context_pool.h"

namespace tilepress {

/// A closed display's address may come back as another display, and its GLX contexts died with it.
class DisplayEnds {
 public:
  static DisplayEnds& instance() {
    static auto* const ends = new DisplayEnds;  // outlives everything
    return *ends;
  }
  void add(ContextPool* pool, ConfigCache* configs) {
    std::lock_guard lock(mutex_);
    pools_.push_back(pool);
    configs_.push_back(configs);
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
    for (ContextPool* pool : ends.pools_) pool->take_all(display);
    for (ConfigCache* configs : ends.configs_) configs->forget(display);
    return 0;
  }

 private:
  std::mutex mutex_;
  std::vector<ContextPool*> pools_;
  std::vector<ConfigCache*> configs_;
  std::vector<Display*> watched_;
};

}  // namespace tilepress
