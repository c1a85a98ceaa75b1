// Pixel kernels, plainly: the definition.
#include "pixels/pixel_kernels.h"

#include <bit>
#include <cstring>

#include "tilepress/bit_io.h"
#include "tilepress/block.h"

namespace tilepress {
namespace {

bool load_traversal(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  bool uniform = true;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    pixels[i] = top_left[kTraversal[i] / 8 * stride + kTraversal[i] % 8];
    uniform &= pixels[i] == pixels[0];
  }
  return uniform;
}

uint32_t solid_blocks(const uint32_t* top_left, uint32_t stride, uint32_t color, uint32_t most) {
  for (uint32_t n = 0; n < most; ++n, top_left += kBlockSide)
    for (uint32_t y = 0; y < kBlockSide; ++y)
      for (uint32_t x = 0; x < kBlockSide; ++x)
        if (top_left[y * stride + x] != color) return n;
  return most;
}

void read_raw(const uint8_t* bytes, uint32_t* raster) {
  BitReader bits({bytes, kMaxRawBlockBits / 8});
  for (const uint8_t place : kTraversal) raster[place] = static_cast<uint32_t>(bits.get(32));
}

uint32_t replace_row(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                     uint32_t* row, uint8_t* changed_blocks) {
  return replace_words(words, 0, count, swap_red_blue, set_bits, row, changed_blocks);
}

uint64_t run_begins(const uint32_t* pixels) {
  uint64_t begins = 1;
  for (uint32_t i = 1; i < kBlockPixels; ++i) begins |= uint64_t{pixels[i] != pixels[i - 1]} << i;
  return begins;
}

uint64_t places_of(const uint32_t* pixels, uint32_t color) {
  uint64_t places = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) places |= uint64_t{pixels[i] == color} << i;
  return places;
}

bool split(const uint32_t* pixels, FewColors& out) {
  out.count = 0;
  for (uint64_t left = ~uint64_t{0}; left != 0;) {
    const auto covered = static_cast<uint32_t>(kBlockPixels - std::popcount(left));
    if (out.count == FewColors::kMost || covered < out.count * FewColors::kPixelsPerColor) return false;
    const uint32_t color = pixels[std::countr_zero(left)];
    const uint64_t places = places_of(pixels, color);
    out.colors[out.count] = color;
    out.places[out.count++] = places;
    left &= ~places;
  }
  return true;
}

}  // namespace

uint32_t replace_words(const std::byte* words, uint32_t begin, uint32_t end, bool swap_red_blue,
                       uint32_t set_bits, uint32_t* row, uint8_t* changed_blocks) {
  uint32_t changed = 0;
  for (uint32_t x = begin; x < end; ++x) {
    uint32_t word;
    std::memcpy(&word, words + size_t{x} * 4, 4);
    if (swap_red_blue) word = (word & 0xFF00FF00u) | (word >> 16 & 0xFFu) | (word & 0xFFu) << 16;
    word |= set_bits;
    if (row[x] == word) continue;
    row[x] = word;
    ++changed;
    if (changed_blocks != nullptr) changed_blocks[x / 8] = 1;
  }
  return changed;
}

constexpr PixelKernels kPlainPixelKernels = {.load_traversal = load_traversal,
                                             .solid_blocks = solid_blocks,
                                             .read_raw = read_raw,
                                             .replace_row = replace_row,
                                             .run_begins = run_begins,
                                             .places_of = places_of,
                                             .split = split};

}  // namespace tilepress
