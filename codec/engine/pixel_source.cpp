// Pixel source: copy or in place, and prefetch.
#include "engine/pixel_source.h"

#include <algorithm>

namespace tilepress {

void PixelSource::begin_frame(const SurfaceView& frame) {
  frame_ = frame;
  const uint64_t tile_bytes = uint64_t{needs_.tile_side} * frame.width * sizeof(uint32_t);
  const bool few_bytes = tile_bytes <= RowPrefetch::kMostBytes;
  in_place_ = !needs_.compares && few_bytes && plane_.refer_to(frame);
  if (!in_place_) plane_.reshape(frame);
  prefetches_ = few_bytes && (in_place_ || !needs_.whole_frame);
  changed_pixels_ = 0;
  if (needs_.notes_changes) changed_blocks_.assign(plane_.blocks(), has_before_ ? 0 : 1);
  if (needs_.whole_frame) copy_rows(0, plane_.blocks_y());
}

void PixelSource::copy_rows(uint32_t begin, uint32_t end) {
  if (in_place_) return;
  changed_pixels_ += plane_.assign_rows(frame_, begin * kBlockSide, end * kBlockSide,
                                        needs_.notes_changes ? changed_blocks_.data() : nullptr);
}

void PixelSource::take_rows(uint32_t begin, uint32_t end) {
  if (!needs_.whole_frame) copy_rows(begin, end);
  if (!prefetches_) return;
  if (in_place_ && begin == 0) {
    aim_prefetch(0);
    prefetch_.step(UINT32_MAX);
  }
  aim_prefetch(end);
}

/// Aims at the row of tiles that begins with row `begin` of blocks.
void PixelSource::aim_prefetch(uint32_t begin) {
  const uint32_t y = std::min(begin * kBlockSide, frame_.height);
  prefetch_.aim(frame_, y, std::min(y + needs_.tile_side, frame_.height));
}

}  // namespace tilepress
