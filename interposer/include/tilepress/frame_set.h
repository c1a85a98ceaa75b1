// Frame set: the ranges of frame numbers of --frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// A set of frame numbers: "0-99,200". Empty = every frame.
class FrameSet {
 public:
  /// Fails for an empty or reversed range and for text that is no number. The error does not repeat `text`.
  static Result<FrameSet> parse(std::string_view text);
  bool contains(uint64_t frame) const;
  bool all() const { return ranges_.empty(); }
  /// Largest frame of the set; nothing when the set is every frame.
  std::optional<uint64_t> last() const;
  std::string text() const;

 private:
  struct Range {
    uint64_t first, last;
  };
  std::vector<Range> ranges_;
};

}  // namespace tilepress
