// CSB cache: a small on-chip memory for lines of the CSB (paper §Reading a Compressed Framebuffer
// Surface).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tilepress {

/// Fully associative; the least recently used line leaves first. Holds line numbers only.
class CsbCache {
 public:
  explicit CsbCache(uint32_t lines) : lines_(lines) {}

  /// Returns true if the cache holds the line. Else inserts it, unless the cache has no lines.
  bool touch(uint64_t line) {
    const auto at = std::find(held_.begin(), held_.end(), line);
    const bool hit = at != held_.end();
    if (hit) held_.erase(at);
    if (!hit && lines_ > 0 && held_.size() == lines_) held_.pop_back();
    if (lines_ > 0) held_.insert(held_.begin(), line);
    return hit;
  }

 private:
  uint32_t lines_;
  std::vector<uint64_t> held_;  ///< most recently used first
};

}  // namespace tilepress
