// X display: whether several threads may use it, and a source's cleanup when the program closes it.
#pragma once

#include <X11/Xlib.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace tilepress {

/// Returns true if `display` was opened after XInitThreads, which libX11 calls by itself from 1.8 on.
bool has_locks(Display* display);

/// A closed display's address may come back as another display, and the display's GLX contexts are gone then.
class DisplayEnds {
 public:
  static DisplayEnds& instance() {
    static auto* const ends = new DisplayEnds;  // outlives everything
    return *ends;
  }
  using End = std::function<void(Display* display)>;
  void add(End end) {
    std::lock_guard lock(mutex_);
    ends_.push_back(std::move(end));
  }
  /// Returns true the first time for `display`.
  bool watch(Display* display) {
    std::lock_guard lock(mutex_);
    if (std::find(watched_.begin(), watched_.end(), display) != watched_.end()) return false;
    watched_.push_back(display);
    return true;
  }
  /// For XESetCloseDisplay.
  static int on_close(Display* display, XExtCodes*) {
    DisplayEnds& all = instance();
    std::lock_guard lock(all.mutex_);
    std::erase(all.watched_, display);
    for (const End& end : all.ends_) end(display);
    return 0;
  }

 private:
  std::mutex mutex_;
  std::vector<End> ends_;
  std::vector<Display*> watched_;
};

}  // namespace tilepress
