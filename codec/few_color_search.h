// Few-colour search: looks for the few colours of a block, where that pays.
#pragma once

#include <algorithm>
#include <cstdint>

#include "simd/kernels.h"

namespace tilepress {

/// Looking in vain costs as much as it saves otherwise, so where blocks have many colours few of them are
/// looked at. What comes out of a frame must not depend on it.
class FewColorSearch {
 public:
  /// The colours of a block of 64 pixels in traversal order, until the next call; null if they are many, or
  /// the block was not looked at.
  const FewColors* look(const uint32_t* pixels) {
    constexpr uint32_t kBest = 12, kFailure = 4, kPause = 7;
    if (pause_ > 0) {
      --pause_;
      return nullptr;
    }
    const bool found = kernels().split(pixels, few_);
    score_ = found ? std::min(score_ + 1, kBest) : score_ - std::min(score_, kFailure);
    if (score_ == 0 && !found) pause_ = kPause;
    return found ? &few_ : nullptr;
  }

 private:
  FewColors few_;
  uint32_t score_ = 0;  ///< how well it went lately
  uint32_t pause_ = 0;  ///< blocks not to look at, when it went badly
};

}  // namespace tilepress
