// Common Colors Dictionary: the colours an FVC held at a frame's end, most frequent first (paper §The CCD;
// spec §4).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "dcp/index_widths.h"
#include "dcp/probe_table.h"
#include "dcp/slot_table.h"
#include "pixels/few_colors.h"
#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/scheme.h"

namespace tilepress {

class Fvc;

/// Built from the FVC of an earlier frame; index 0 is the most frequent colour.
struct Ccd {
  uint32_t entries = 0;          ///< slots N = those of the FVC; colors may be fewer
  std::vector<uint32_t> colors;  ///< by index
  std::vector<uint32_t> counts;  ///< FVC counts, descending
  uint64_t samples = 0;          ///< pixels that entered the FVC
  double coverage = 0;           ///< FVC coverage of the frame it came from

  uint32_t index_bits() const { return static_cast<uint32_t>(std::bit_width(entries) - 1); }  ///< M = log2 N
  void build(const Fvc& fvc);
};

/// Finds colours in a CCD. Small dictionaries get a table without collisions, found by trying multipliers,
/// which a SIMD kernel reads many pixels at a time; large ones an open-addressed table.
class CcdLookup {
 public:
  void build(const Ccd& ccd);
  /// CCD index of the colour, kNotInCcd if it has none.
  uint16_t find(uint32_t color) const {
    if (has_slots_) {
      const uint32_t slot = slots_.find(color);
      return slot == SlotTable::kAbsent ? kNotInCcd : static_cast<uint16_t>(slot);
    }
    for (uint32_t at = table_.bucket(color);; at = (at + 1) & (table_.size() - 1))
      if (table_.values[at] == kNotInCcd || table_.colors[at] == color)
        return static_cast<uint16_t>(table_.values[at]);
  }
  /// A block of 64 pixels in traversal order: its indices, and the widths of its sub-blocks; see
  /// BlockContext.
  void find_block(const uint32_t* pixels, uint16_t* indices, uint8_t* widths) const;
  /// The same for a block of few colours.
  void find_block(const uint32_t* pixels, const FewColors& few, uint16_t* indices, uint8_t* widths) const;
  /// The dictionary's colours by index, for kernels; null if it is not kept so.
  const SlotTable* slots() const { return has_slots_ ? &slots_ : nullptr; }

 private:
  bool place_all(const Ccd& ccd, bool probing);
  ProbeTable table_;
  bool collision_free_ = false;
  SlotTable slots_;
  bool has_slots_ = false;  ///< slots_ holds the dictionary, and table_ nothing
};

/// The reversed dictionary that travels with a compressed surface: slots of a valid bit and a colour, so
/// (pixel bits + 1) bits each, 33 for 32-bit pixels.
struct Rccd {
  uint32_t slots = 0;
  std::vector<uint32_t> colors;  ///< by index; the valid ones

  /// Writes the first `slots` entries of `ccd`.
  static void write(const Ccd& ccd, uint32_t slots, uint32_t pixel_bits, BitWriter& out);
  /// False if the number of slots is not a power of two up to 1024, or a valid slot follows an invalid one.
  bool read(BitReader& in, uint64_t slot_count, uint32_t pixel_bits);
};

}  // namespace tilepress
