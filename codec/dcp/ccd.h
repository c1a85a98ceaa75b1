// Common Colors Dictionary: the colours of an FVC at a frame's end, most frequent first (paper §The CCD).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "dcp/index_widths.h"
#include "dcp/probe_table.h"
#include "dcp/slot_table.h"
#include "pixels/few_colors.h"
#include "tilepress/block.h"

namespace tilepress {

class Fvc;

/// Built from the FVC of an earlier frame; index 0 is the most frequent colour.
struct Ccd {
  uint32_t entries = 0;          ///< slots N of the FVC; the colours may be fewer
  std::vector<uint32_t> colors;  ///< by index
  std::vector<uint32_t> counts;  ///< FVC counts, descending
  uint64_t samples = 0;          ///< pixels that entered the FVC
  double coverage = 0;           ///< FVC coverage of its frame

  uint32_t index_bits() const { return static_cast<uint32_t>(std::bit_width(entries) - 1); }  ///< M = log2 N
  void build(const Fvc& fvc);
};

/// Finds colours in a CCD. A small dictionary gets a collision-free table, found by trying multipliers, that
/// SIMD kernels read many pixels at a time. A large dictionary gets an open-addressed table.
class CcdLookup {
 public:
  void build(const Ccd& ccd);
  /// Returns the CCD index of the colour, or kNotInCcd.
  uint16_t find(uint32_t color) const {
    if (has_slots_) {
      const uint32_t slot = slots_.find(color);
      return slot == SlotTable::kAbsent ? kNotInCcd : static_cast<uint16_t>(slot);
    }
    for (uint32_t at = table_.bucket(color);; at = (at + 1) & (table_.size() - 1))
      if (table_.values[at] == kNotInCcd || table_.colors[at] == color)
        return static_cast<uint16_t>(table_.values[at]);
  }
  /// Looks up 64 pixels in traversal order: fills 64 indices, and 16 widths of sub-blocks; see CcdView.
  void find_block(const uint32_t* pixels, uint16_t* indices, uint8_t* widths) const;
  /// The same for a block of few colours.
  void find_block(const uint32_t* pixels, const FewColors& few, uint16_t* indices, uint8_t* widths) const;
  /// Returns the dictionary as a slot table, or null if it is not kept as one.
  const SlotTable* slots() const { return has_slots_ ? &slots_ : nullptr; }

 private:
  bool place_all(const Ccd& ccd, bool probing);
  ProbeTable table_;
  bool collision_free_ = false;
  SlotTable slots_;
  bool has_slots_ = false;  ///< slots_ holds the dictionary; table_ is not used
};

}  // namespace tilepress
