// Scalar kernels: the plain definition of every kernel.
#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <numeric>

#include "ras/ras_samples.h"
#include "simd/index_widths.h"
#include "simd/kernel_sets.h"
#include "simd/mask_runs.h"
#include "simd/replace_words.h"
#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/scheme.h"

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

uint32_t solid_blocks(const uint32_t* top_left, uint32_t stride, uint32_t color, uint32_t most) {
  for (uint32_t n = 0; n < most; ++n, top_left += kBlockSide)
    for (uint32_t y = 0; y < kBlockSide; ++y)
      for (uint32_t x = 0; x < kBlockSide; ++x)
        if (top_left[y * stride + x] != color) return n;
  return most;
}

void find(const uint32_t* pixels, const ProbeTable& table, uint16_t* indices, uint8_t* widths) {
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t at = table.bucket(pixels[i]);
    indices[i] = table.colors[at] == pixels[i] ? static_cast<uint16_t>(table.values[at]) : kNotInCcd;
  }
  fill_widths(indices, widths);
}

uint64_t places_of(const uint32_t* pixels, uint32_t color) {
  uint64_t places = 0;
  for (uint32_t i = 0; i < kLanes; ++i) places |= uint64_t{pixels[i] == color} << i;
  return places;
}

bool split(const uint32_t* pixels, FewColors& out) {
  out.count = 0;
  for (uint64_t left = ~uint64_t{0}; left != 0;) {
    const auto covered = static_cast<uint32_t>(kLanes - std::popcount(left));
    if (out.count == FewColors::kMost || covered < out.count * FewColors::kPixelsPerColor) return false;
    const uint32_t color = pixels[std::countr_zero(left)];
    const uint64_t places = places_of(pixels, color);
    out.colors[out.count] = color;
    out.places[out.count++] = places;
    left &= ~places;
  }
  return true;
}

void find_few(const uint32_t*, const FewColors& few, const uint32_t* few_values, uint16_t* indices,
              uint8_t* widths) {
  for (uint32_t n = 0; n < few.count; ++n)
    for (uint32_t i = 0; i < kLanes; ++i)
      if ((few.places[n] >> i & 1) != 0) indices[i] = static_cast<uint16_t>(few_values[n]);
  fill_widths(indices, widths);
}

void pack(const uint16_t* indices, const uint8_t* widths, uint32_t* packed) {
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    packed[sub] = 0;
    if (widths[sub] == kRawWidth) continue;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i)
      packed[sub] = packed[sub] << widths[sub] | indices[sub * kSubBlockPixels + i];
  }
}

uint32_t count_up_to(const uint8_t* widths, uint32_t limit) {
  return static_cast<uint32_t>(
      std::count_if(widths, widths + kSubBlocks, [&](uint32_t width) { return width <= limit; }));
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

Smallest find_smallest(const uint32_t* counts, uint32_t stride) {
  Smallest found = {0, ~0u, ~0u};
  for (uint32_t i = 0; i < kLanes; ++i) {
    uint32_t count = 0;
    for (uint32_t n = 0; n < 4; ++n) count += counts[i + n * stride];
    if (count < found.smallest)
      found = {i, count, found.smallest};
    else
      found.second = std::min(found.second, count);
  }
  return found;
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

uint64_t count_runs(const uint32_t* pixels, uint64_t begins, uint32_t end, ColorBucket* table,
                    size_t buckets) {
  uint64_t others = 0;
  for_each_mask_run(begins, end, [&](uint32_t first, uint32_t length) {
    ColorBucket& bucket = table[ColorBucket::of(pixels[first], buckets)];
    const uint32_t place = bucket.find(pixels[first]);
    if (place < ColorBucket::kPlaces)
      bucket.counts[place] += length;
    else
      others |= uint64_t{1} << first;
  });
  return others;
}

int32_t median_edge(int32_t a, int32_t b, int32_t c) {
  if (c >= std::max(a, b)) return std::min(a, b);
  if (c <= std::min(a, b)) return std::max(a, b);
  return a + b - c;
}

/// The k of a group and the bits of its code, header included. `begin`: 1 in the group of the first pixel.
void choose_ras_code(const RasGroups& groups, uint32_t at, uint32_t begin, uint16_t& k, uint64_t& length) {
  uint32_t any = 0;
  for (uint32_t i = 0; i < 4; ++i) any |= groups.residuals[i][at];
  k = kRasZeroGroup;
  length = 3;
  if (any == 0) return;
  length = ~uint64_t{0};
  for (uint16_t candidate = 0; candidate <= kRasLargestK; ++candidate) {
    uint64_t bits = 3;
    for (uint32_t i = begin; i < 4; ++i) bits += (groups.residuals[i][at] >> candidate) + 1u + candidate;
    if (bits >= length) continue;
    length = bits;
    k = candidate;
  }
}

void ras_groups(const int16_t* samples, RasGroups& groups) {
  for (uint32_t group = 0; group < kSubBlocks; ++group)
    for (uint32_t plane = 0; plane < 4; ++plane) {
      const uint32_t at = ras_group_index(plane, group), begin = group == 0 ? 1 : 0;
      for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t x = kTraversal[4 * group + i] % 8, y = kTraversal[4 * group + i] / 8;
        const int16_t* sample = samples + ras_sample_index(x, y) + plane;
        const int32_t e =
            sample[0] - median_edge(sample[-4], sample[-kRasRowSamples], sample[-kRasRowSamples - 4]);
        groups.residuals[i][at] = static_cast<uint16_t>(e >= 0 ? 2 * e : -2 * e - 1);
      }
      uint16_t& k = groups.k[at];
      uint64_t& length = groups.lengths[at];
      choose_ras_code(groups, at, begin, k, length);
      uint64_t& code = groups.codes[at];
      code = k;
      if (k == kRasZeroGroup || length > kMaxBitsPerCall) continue;
      for (uint32_t i = begin; i < 4; ++i) {
        const uint32_t u = groups.residuals[i][at], ones = u >> k;
        code = (code << ones | ((uint64_t{1} << ones) - 1)) << 1;
        code = code << k | (u & ((1u << k) - 1));
      }
    }
}

uint32_t ras_code_bits(const int16_t* samples) {
  RasGroups groups;
  ras_groups(samples, groups);
  return static_cast<uint32_t>(
      std::accumulate(std::begin(groups.lengths), std::end(groups.lengths), uint64_t{0}));
}

uint32_t replace_row(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                     uint32_t* row, uint8_t* changed_blocks) {
  return replace_words(words, 0, count, swap_red_blue, set_bits, row, changed_blocks);
}

void ras_restore(int16_t* samples) {
  constexpr int32_t kRow = 4 * kBlockSide;
  for (int32_t i = 4; i < 4 * static_cast<int32_t>(kBlockPixels); ++i) {
    int16_t* at = samples + i;
    const int32_t prediction = i < kRow       ? at[-4]
                               : i % kRow < 4 ? at[-kRow]
                                              : median_edge(at[-4], at[-kRow], at[-kRow - 4]);
    *at = static_cast<int16_t>(*at + prediction);
  }
}

bool narrow_bytes(const int16_t* samples, uint32_t* pixels) {
  uint32_t beyond = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    pixels[i] = 0;
    for (uint32_t c = 0; c < 4; ++c) {
      const auto sample = static_cast<uint16_t>(samples[4 * i + c]);
      beyond |= sample >> 8;
      pixels[i] |= (sample & 0xFFu) << (8 * c);
    }
  }
  return beyond == 0;
}

void widen_bytes(const uint32_t* top_left, uint32_t stride, int16_t* samples) {
  for (uint32_t y = 0; y < kBlockSide; ++y)
    for (uint32_t x = 0; x < kBlockSide; ++x)
      for (uint32_t c = 0; c < 4; ++c)
        samples[ras_sample_index(x, y) + c] =
            static_cast<int16_t>(top_left[y * stride + x] >> (8 * c) & 0xFF);
}

void read_raw(const uint8_t* bytes, uint32_t* raster) {
  BitReader bits({bytes, kMaxRawBlockBits / 8});
  for (const uint8_t place : kTraversal) raster[place] = static_cast<uint32_t>(bits.get(32));
}

}  // namespace

bool load_slots_plainly(const uint32_t* top_left, uint32_t stride, uint32_t* pixels, SlotLookups& lookups) {
  if (load_traversal(top_left, stride, pixels)) return true;
  if (lookups.dictionary != nullptr)
    index_slots_plainly(pixels, *lookups.dictionary, lookups.indices, lookups.widths);
  if (lookups.members != nullptr) lookups.found = find_slots_plainly(pixels, *lookups.members, lookups.slots);
  return false;
}

FoundSlots find_slots_plainly(const uint32_t* pixels, const SlotTable& table, uint8_t* slots) {
  FoundSlots found = {0, 1};
  for (uint32_t i = 0; i < kLanes; ++i) {
    slots[i] = static_cast<uint8_t>(table.find(pixels[i]));
    found.known |= uint64_t{slots[i] != SlotTable::kAbsent} << i;
    if (i > 0) found.begins |= uint64_t{slots[i] != slots[i - 1]} << i;
  }
  if (found.known == 0) found.begins = run_begins(pixels);
  return found;
}

uint64_t count_slots_plainly(const uint8_t* slots, uint64_t wanted, uint32_t* counts) {
  for (uint32_t n = 0; n < 4 && wanted != 0; ++n) {
    const uint8_t slot = slots[std::countr_zero(wanted)];
    for (uint32_t i = 0; i < kLanes; ++i) {
      if ((wanted >> i & 1) == 0 || slots[i] != slot) continue;
      ++counts[slot];
      wanted &= ~(uint64_t{1} << i);
    }
  }
  return wanted;
}

void index_slots_plainly(const uint32_t* pixels, const SlotTable& table, uint16_t* indices, uint8_t* widths) {
  uint8_t slots[kLanes];
  find_slots_plainly(pixels, table, slots);
  for (uint32_t i = 0; i < kLanes; ++i) indices[i] = slots[i] == SlotTable::kAbsent ? kNotInCcd : slots[i];
  fill_widths(indices, widths);
}

uint32_t code_sum_plainly(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits) {
  uint32_t sum = 0;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
      const uint16_t index = indices[sub * kSubBlockPixels + i];
      bits += index == kNotInCcd ? raw_bits : lengths[index];
    }
    sum += std::min(bits, raw_bits);
  }
  return sum;
}

WrittenBlock write_sub_blocks_plainly(const uint32_t* pixels, const uint16_t* indices, const uint8_t* widths,
                                      uint32_t mark_bits, uint8_t* out) {
  WrittenBlock written = {};
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    uint64_t& marks = written.marks[sub / 8];
    marks = marks << mark_bits | (widths[sub] & ((1u << mark_bits) - 1));
  }
  BitWriter bits({out, kMaxRawBlockBits / 8});
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint8_t width = widths[i / kSubBlockPixels];
    width == kRawWidth ? bits.put(pixels[i], 32) : bits.put(indices[i], width);
  }
  bits.flush();
  written.bits = static_cast<uint32_t>(bits.bit_count());
  written.clean_bytes = std::min(kMaxRawBlockBits / 8, (written.bits / 512 + 1) * 64);
  std::fill(out + (written.bits + 7) / 8, out + written.clean_bytes, uint8_t{0});
  return written;
}

uint32_t read_indices_plainly(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits,
                              uint32_t most_bits, const uint32_t* colors, uint32_t known, uint32_t* raster) {
  BitReader bits({bytes, 64});
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t sub = i / kSubBlockPixels;
    const uint64_t width = marks[sub / 8] >> (7 - sub % 8) * mark_bits & ((1u << mark_bits) - 1);
    const uint64_t index = width <= most_bits ? bits.get(static_cast<uint32_t>(width)) : known;
    if (index >= known) return kNotAllIndices;
    raster[kTraversal[i]] = colors[index];
  }
  return static_cast<uint32_t>(bits.position());
}

const Kernels& scalar_kernels() {
  static const Kernels kScalar = {
      .name = "scalar",
      .byte_permutes = false,
      .load_traversal = load_traversal,
      .load_slots = load_slots_plainly,
      .solid_blocks = solid_blocks,
      .find = find,
      .find_slots = find_slots_plainly,
      .count_slots = count_slots_plainly,
      .index_slots = index_slots_plainly,
      .places_of = places_of,
      .split = split,
      .find_few = find_few,
      .pack = pack,
      .write_sub_blocks = write_sub_blocks_plainly,
      .read_indices = read_indices_plainly,
      .read_raw = read_raw,
      .code_sum = code_sum_plainly,
      .count_up_to = count_up_to,
      .members = members,
      .find_smallest = find_smallest,
      .compact = compact,
      .run_begins = run_begins,
      .count_runs = count_runs,
      .ras_code_bits = ras_code_bits,
      .ras_groups = ras_groups,
      .replace_row = replace_row,
      .ras_restore = ras_restore,
      .narrow_bytes = narrow_bytes,
      .widen_bytes = widen_bytes,
  };
  return kScalar;
}

}  // namespace tilepress
