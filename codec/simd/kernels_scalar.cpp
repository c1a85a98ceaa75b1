// Scalar kernels: the plain definition of every kernel.
#include <algorithm>
#include <bit>
#include <cstring>

#include "ras/ras_samples.h"
#include "simd/kernel_sets.h"
#include "simd/replace_words.h"
#include "tilepress/block.h"

namespace tilepress {
namespace {

bool load_traversal(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  bool uniform = true;
  for (uint32_t i = 0; i < kLanes; ++i) {
    pixels[i] = top_left[kTraversal[i] / 8 * stride + kTraversal[i] % 8];
    uniform &= pixels[i] == pixels[0];
  }
  return uniform;
}

bool is_solid(const uint32_t* top_left, uint32_t stride, uint32_t color) {
  for (uint32_t y = 0; y < kBlockSide; ++y)
    for (uint32_t x = 0; x < kBlockSide; ++x)
      if (top_left[y * stride + x] != color) return false;
  return true;
}

void fill_largest(const uint32_t* values, uint32_t* largest) {
  for (uint32_t i = 0; i < kLanes; i += 4)
    std::fill_n(largest + i, 4, std::max({values[i], values[i + 1], values[i + 2], values[i + 3]}));
}

void find(const uint32_t* pixels, const ProbeTable& table, uint32_t absent, uint32_t* values,
          uint32_t* largest) {
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t at = table.bucket(pixels[i]);
    values[i] = table.colors[at] == pixels[i] ? table.values[at] : absent;
  }
  fill_largest(values, largest);
}

bool split(const uint32_t* pixels, FewColors& out) {
  out.count = 0;
  for (uint64_t left = ~uint64_t{0}; left != 0;) {
    const auto covered = static_cast<uint32_t>(kLanes - std::popcount(left));
    if (out.count == FewColors::kMost || covered < out.count * FewColors::kPixelsPerColor) return false;
    const uint32_t color = pixels[std::countr_zero(left)];
    uint64_t places = 0;
    for (uint32_t i = 0; i < kLanes; ++i) places |= uint64_t{pixels[i] == color} << i;
    out.colors[out.count] = color;
    out.places[out.count++] = places;
    left &= ~places;
  }
  return true;
}

void find_few(const uint32_t*, const FewColors& few, const uint32_t* few_values, uint32_t* values,
              uint32_t* largest) {
  for (uint32_t n = 0; n < few.count; ++n)
    for (uint32_t i = 0; i < kLanes; ++i)
      if ((few.places[n] >> i & 1) != 0) values[i] = few_values[n];
  fill_largest(values, largest);
}

uint32_t width_sum(const uint32_t* largest, uint32_t absent, uint32_t raw_bits) {
  uint32_t bits = 0;
  for (uint32_t i = 0; i < kLanes; ++i)
    bits += largest[i] == absent ? raw_bits : static_cast<uint32_t>(std::bit_width(largest[i]));
  return bits;
}

void pack(const uint32_t* indices, const uint32_t* largest, uint32_t absent, uint32_t* packed,
          uint32_t* widths) {
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint32_t top = largest[sub * kSubBlockPixels];
    const uint32_t width = top == absent ? 0 : static_cast<uint32_t>(std::bit_width(top));
    widths[sub] = top == absent ? kRawWidth : width;
    packed[sub] = 0;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i)
      packed[sub] = packed[sub] << width | indices[sub * kSubBlockPixels + i];
  }
}

uint32_t count_below(const uint32_t* largest, uint32_t limit) {
  return static_cast<uint32_t>(
      std::count_if(largest, largest + kLanes, [&](uint32_t v) { return v < limit; }));
}

uint64_t members(const uint32_t* pixels, const ProbeTable& table, const uint32_t* crowded_colors,
                 uint32_t crowded, uint32_t* places) {
  uint64_t mask = 0;
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t bucket = table.bucket(pixels[i]);
    places[i] = table.colors[bucket] == pixels[i] ? bucket : table.size();
    for (uint32_t c = 0; c < crowded; ++c)
      if (pixels[i] == crowded_colors[c]) places[i] = table.size() + 1 + c;
    mask |= uint64_t{places[i] != table.size()} << i;
  }
  return mask;
}

uint64_t compact(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out) {
  uint64_t alike = 0;
  for (uint32_t count = 0; mask != 0; mask &= mask - 1, ++count) {
    out[count] = pixels[std::countr_zero(mask)];
    alike |= uint64_t{out[count] == before} << count;
    before = out[count];
  }
  return alike;
}

uint64_t run_begins(const uint32_t* pixels) {
  uint64_t begins = 1;
  for (uint32_t i = 1; i < kLanes; ++i) begins |= uint64_t{pixels[i] != pixels[i - 1]} << i;
  return begins;
}

int32_t median_edge(int32_t a, int32_t b, int32_t c) {
  if (c >= std::max(a, b)) return std::min(a, b);
  if (c <= std::min(a, b)) return std::max(a, b);
  return a + b - c;
}

uint32_t ras_code_bits(const int16_t* samples) {
  uint32_t bits = 0;
  for (uint32_t group = 0; group < kSubBlocks; ++group)
    for (uint32_t plane = 0; plane < 4; ++plane) {
      uint32_t u[4], any = 0;
      for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t x = kTraversal[4 * group + i] % 8, y = kTraversal[4 * group + i] / 8;
        const int16_t* at = samples + ras_sample_index(x, y) + plane;
        const int32_t e = at[0] - median_edge(at[-4], at[-kRasRowSamples], at[-kRasRowSamples - 4]);
        any |= u[i] = e >= 0 ? 2u * static_cast<uint32_t>(e) : 2u * static_cast<uint32_t>(-e) - 1;
      }
      if (any == 0) {
        bits += 3;
        continue;
      }
      uint32_t best = ~0u;
      for (uint32_t k = 0; k <= 6; ++k) {
        uint32_t sum = 3;
        for (uint32_t i = group == 0 ? 1 : 0; i < 4; ++i) sum += (u[i] >> k) + 1 + k;
        best = std::min(best, sum);
      }
      bits += best;
    }
  return bits;
}

uint32_t replace_row(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                     uint32_t* row, uint8_t* changed_blocks) {
  return replace_words(words, 0, count, swap_red_blue, set_bits, row, changed_blocks);
}

void widen_bytes(const uint32_t* top_left, uint32_t stride, int16_t* samples) {
  for (uint32_t y = 0; y < kBlockSide; ++y)
    for (uint32_t x = 0; x < kBlockSide; ++x)
      for (uint32_t c = 0; c < 4; ++c)
        samples[ras_sample_index(x, y) + c] =
            static_cast<int16_t>(top_left[y * stride + x] >> (8 * c) & 0xFF);
}

}  // namespace

const Kernels& scalar_kernels() {
  static const Kernels kScalar = {"scalar", load_traversal, is_solid,      find,        split,
                                  find_few, width_sum,      pack,          count_below, members,
                                  compact,  run_begins,     ras_code_bits, replace_row, widen_bytes};
  return kScalar;
}

}  // namespace tilepress
