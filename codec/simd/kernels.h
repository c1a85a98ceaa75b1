// Kernels: the inner loops of a block, one set per instruction set. The scalar set is the definition.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "ras/ras_samples.h"
#include "simd/color_buckets.h"
#include "simd/probe_table.h"
#include "simd/slot_table.h"
#include "tilepress/block.h"

namespace tilepress {

/// Pixels of a block in traversal order.
constexpr uint32_t kLanes = 64;

/// The colours of a block that has few, in the order in which they first come.
struct FewColors {
  static constexpr uint32_t kMost = 8;
  /// After n colours at least this many pixels must be of one of them, or to go on does not pay.
  static constexpr uint32_t kPixelsPerColor = 6;
  uint32_t count = 0;
  uint32_t colors[kMost];
  uint64_t places[kMost];  ///< bit i: pixel i is of this colour
};

struct FoundSlots {
  uint64_t known;  ///< bit i: pixel i has a slot
  /// Bit i: pixel i is of another slot than the one before it or, if no pixel has any, of another colour. Bit
  /// 0 is set.
  uint64_t begins;
};

/// What load_slots looks up, and where to.
struct SlotLookups {
  const SlotTable* dictionary;  ///< for index_slots; null: not wanted
  uint16_t* indices;
  uint8_t* widths;
  const SlotTable* members;  ///< for find_slots; null: not wanted
  uint8_t* slots;
  FoundSlots found;
};

struct WrittenBlock {
  uint32_t bits;         ///< written
  uint32_t clean_bytes;  ///< from the first on: these bits, and zeros to the end of a line of 64 bytes
  uint64_t marks[2];     ///< of eight sub-blocks each, the low bits of their widths, the first on top
};

constexpr uint32_t kNotAllIndices = 0xFFFFFFFF;

struct Smallest {
  uint32_t at;        ///< the first of the smallest
  uint32_t smallest;  ///< value
  uint32_t second;    ///< the smallest of the others
};

struct Kernels {
  const char* name;

  /// load_slots, find_slots, index_slots and write_sub_blocks are quicker than members, find and putting
  /// bits.
  bool byte_permutes;

  /// Copies an 8×8 block out of a plane (`stride` words from row to row) into traversal order. True if all 64
  /// pixels are equal.
  bool (*load_traversal)(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);

  /// The same, and looks the pixels up unless they are all equal.
  bool (*load_slots)(const uint32_t* top_left, uint32_t stride, uint32_t* pixels, SlotLookups& lookups);

  /// Of `most` 8×8 blocks side by side, how many, from the first on, are all `color`.
  uint32_t (*solid_blocks)(const uint32_t* top_left, uint32_t stride, uint32_t color, uint32_t most);

  /// indices[i] = the table's value of pixels[i], kNotInCcd if it has none; widths[s] = the bit width of the
  /// largest index of sub-block s, kRawWidth if one of its pixels has none. For collision-free tables.
  void (*find)(const uint32_t* pixels, const ProbeTable& table, uint16_t* indices, uint8_t* widths);

  /// slots[i] = the slot of pixel i of the block, SlotTable::kAbsent if it has none.
  FoundSlots (*find_slots)(const uint32_t* pixels, const SlotTable& table, uint8_t* slots);

  /// Adds to counts[slots[i]] the number of pixels of that slot, slot by slot, until those of `wanted` are
  /// counted, or those of four slots are; returns the pixels left.
  uint64_t (*count_slots)(const uint8_t* slots, uint64_t wanted, uint32_t* counts);

  /// As find, where the indices are slots.
  void (*index_slots)(const uint32_t* pixels, const SlotTable& table, uint16_t* indices, uint8_t* widths);

  /// Bit i of the result: pixels[i] is `color`.
  uint64_t (*places_of)(const uint32_t* pixels, uint32_t color);

  /// False if the block has too many colours, see FewColors.
  bool (*split)(const uint32_t* pixels, FewColors& out);

  /// As find, where the values of the block's few colours are known.
  void (*find_few)(const uint32_t* pixels, const FewColors& few, const uint32_t* few_values,
                   uint16_t* indices, uint8_t* widths);

  /// packed[s] = the four indices of sub-block s, the first on top, of widths[s] bits each; of no meaning
  /// where that is kRawWidth. Widths up to 8.
  void (*pack)(const uint16_t* indices, const uint8_t* widths, uint32_t* packed);

  /// Writes a block of 32-bit pixels as VDCP does: of each sub-block its indices, as many bits each as its
  /// width says, or its pixels; from the most significant bit of out[0] on, 256 bytes. Widths up to 7. What
  /// follows becomes 0 for WrittenBlock::clean_bytes at least. A mark has `mark_bits` ≤ 7.
  WrittenBlock (*write_sub_blocks)(const uint32_t* pixels, const uint16_t* indices, const uint8_t* widths,
                                   uint32_t mark_bits, uint8_t* out);

  /// The other way round: restores a block that is all indices, of up to `most_bits` ≤ 7 bits and below
  /// `known` ≤ 64, of `colors`, to raster order. Reads 64 bytes. Returns the number of bits; kNotAllIndices
  /// if the block is none such, and what `raster` holds then is of no meaning.
  uint32_t (*read_indices)(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits,
                           uint32_t most_bits, const uint32_t* colors, uint32_t known, uint32_t* raster);

  /// Restores a raw block of 32-bit pixels to raster order, from 256 bytes.
  void (*read_raw)(const uint8_t* bytes, uint32_t* raster);

  /// Bits of a block in codes of `lengths`, up to 127 each, by index: of each sub-block the sum over its
  /// indices, but `raw_bits` where that is more or one is kNotInCcd. raw_bits is 64 or 128, indices are below
  /// 64.
  uint32_t (*code_sum)(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits);

  /// Number of sub-blocks of a width up to `limit` (below kRawWidth).
  uint32_t (*count_up_to)(const uint8_t* widths, uint32_t limit);

  /// Bit i of the result: pixels[i] is in the table or one of the `crowded` colours. places[i] = its bucket,
  /// or table size + 1 + its number among the crowded; table size for the others.
  uint64_t (*members)(const uint32_t* pixels, const ProbeTable& table, const uint32_t* crowded_colors,
                      uint32_t crowded, uint32_t* places);

  /// Of 64 values, number i being the sum of counts[i + n · stride] for n = 0 … 3.
  Smallest (*find_smallest)(const uint32_t* counts, uint32_t stride);

  /// Packs the pixels whose bit of `mask` is set: out[0], out[1], ... in order; what follows them, up to
  /// out[79], may be overwritten. Bit i of the result: out[i] equals the one before it, out[0] `before`.
  uint64_t (*compact)(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out);

  /// Bit i of the result: of 64 pixels, number i differs from the one before it; bit 0 is set.
  uint64_t (*run_begins)(const uint32_t* pixels);

  /// Bit i of `begins` says that a run of pixels of one colour begins at pixel i; the last ends before `end`.
  /// Adds the length of each to the count of its colour where the colour's own bucket holds that; returns the
  /// beginnings of the others.
  uint64_t (*count_runs)(const uint32_t* pixels, uint64_t begins, uint32_t end, ColorBucket* table,
                         size_t buckets);

  /// Bits of the Golomb-Rice codes of four planes with their group headers, without the first pixels.
  /// samples: rows of 40 values, row -1 to 7; see ras_samples.h.
  uint32_t (*ras_code_bits)(const int16_t* samples);

  /// The codes themselves.
  void (*ras_groups)(const int16_t* samples, RasGroups& groups);

  /// Copies `count` words of 4 bytes, of any alignment, to `row`, bytes 0 and 2 of each exchanged if
  /// `swap_red_blue`, and the bits of `set_bits` set. Returns how many words of `row` were not the same
  /// before; where one of words 8b to 8b + 7 was not, changed_blocks[b] becomes other than 0 (null: not
  /// wanted).
  uint32_t (*replace_row)(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                          uint32_t* row, uint8_t* changed_blocks);

  /// From residuals, 4 planes a pixel, to samples: to each is added what its neighbours predict. Pixel (x, y)
  /// is at 32 * y + 4 * x. Of residuals no encoder makes, the first sample out of its range is right.
  void (*ras_restore)(int16_t* samples);

  /// Samples of four 8-bit channels, as ras_restore leaves them, to pixels. False: one does not fit.
  bool (*narrow_bytes)(const int16_t* samples, uint32_t* pixels);

  /// ras_samples of an 8×8 block of four 8-bit channels, borders left out.
  void (*widen_bytes)(const uint32_t* top_left, uint32_t stride, int16_t* samples);
};

/// The set in use; null until it is asked for.
inline std::atomic<const Kernels*> chosen_kernels = nullptr;
const Kernels& choose_kernels();
inline const Kernels& kernels() {
  const Kernels* chosen = chosen_kernels.load(std::memory_order_relaxed);
  return chosen != nullptr ? *chosen : choose_kernels();
}

}  // namespace tilepress
