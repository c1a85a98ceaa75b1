// Pixel kernels: rows into planes, blocks out of planes, and what pixels are alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cpu/cpu_target.h"
#include "pixels/few_colors.h"

namespace tilepress {

struct PixelKernels {
  /// Copies an 8×8 block out of a plane with `stride` words per row, into traversal order. Returns true if
  /// all 64 pixels are equal.
  bool (*load_traversal)(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);

  /// Counts blocks of one colour. Of `most` 8×8 blocks side by side, returns how many at the front have only
  /// pixels of `color`.
  uint32_t (*solid_blocks)(const uint32_t* top_left, uint32_t stride, uint32_t color, uint32_t most);

  /// Copies a raw block of 32-bit pixels, 256 bytes, into raster order.
  void (*read_raw)(const uint8_t* bytes, uint32_t* raster);

  /// Copies `count` words of 4 bytes, of any alignment, to `row`. `swap_red_blue` exchanges bytes 0 and 2 of
  /// each word; the bits of `set_bits` are set. Returns how many words of `row` changed. If one of words 8b
  /// to 8b + 7 changed, sets changed_blocks[b] to a value other than 0. `changed_blocks` may be null.
  uint32_t (*replace_row)(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                          uint32_t* row, uint8_t* changed_blocks);

  /// Bit i of the result: of 64 pixels, number i differs from the one before it. Bit 0 is set.
  uint64_t (*run_begins)(const uint32_t* pixels);

  /// Bit i of the result: of 64 pixels, number i is `color`.
  uint64_t (*places_of)(const uint32_t* pixels, uint32_t color);

  /// Splits 64 pixels by colour. Returns false if the block has too many colours, see FewColors.
  bool (*split)(const uint32_t* pixels, FewColors& out);
};

extern const PixelKernels kPlainPixelKernels;
extern const KernelSets<PixelKernels> kPixelKernelSets;
inline const PixelKernels& pixel_kernels() {
  return kPixelKernelSets.in_use();
}

/// The plain replace_row for words `begin` to `end`.
uint32_t replace_words(const std::byte* words, uint32_t begin, uint32_t end, bool swap_red_blue,
                       uint32_t set_bits, uint32_t* row, uint8_t* changed_blocks);

}  // namespace tilepress
