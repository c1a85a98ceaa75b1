// Few-colour search: splits blocks by colour where that is likely to succeed.
#pragma once

#include <algorithm>
#include <cstdint>

#include "pixels/pixel_kernels.h"

namespace tilepress {

/// A split that fails costs as much as a split that succeeds saves. Where blocks have many colours, the
/// search skips most of them. The results of a frame must not depend on which blocks are skipped.
class FewColorSearch {
 public:
  /// Returns the colours of a block of 64 pixels in traversal order, valid until the next call. Returns null
  /// if the colours are many or the block is skipped.
  const FewColors* look(const uint32_t* pixels) {
    constexpr uint32_t kBest = 12, kFailure = 4, kPause = 7;
    if (pause_ > 0) {
      --pause_;
      return nullptr;
    }
    const bool found = pixel_kernels().split(pixels, few_);
    score_ = found ? std::min(score_ + 1, kBest) : score_ - std::min(score_, kFailure);
    if (score_ == 0 && !found) pause_ = kPause;
    return found ? &few_ : nullptr;
  }

 private:
  FewColors few_;
  uint32_t score_ = 0;  ///< high after successes
  uint32_t pause_ = 0;  ///< blocks left to skip
};

}  // namespace tilepress
