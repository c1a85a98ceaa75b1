// Few colours: the colours of a block that has few.
#pragma once

#include <cstdint>

namespace tilepress {

/// In the order in which the block shows them.
struct FewColors {
  static constexpr uint32_t kMost = 8;
  /// A split stops after n colours unless they cover at least n times this many pixels: more would be slower
  /// than a full lookup.
  static constexpr uint32_t kPixelsPerColor = 6;
  uint32_t count = 0;
  uint32_t colors[kMost];
  uint64_t places[kMost];  ///< bit i: pixel i has this colour
};

}  // namespace tilepress
