// Size classes: the sizes that streams are padded to, and their numbers in the CSB.
#pragma once

#include <bit>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// In the order of the key's choices.
enum class SizeChoice : uint8_t { kThree, kTwo, kBurst };

/// Class numbers are CSB values.
///   three (default)  0, 1, 2 = 25, 50, 75 % of the raw block; 3 = raw       2 bits
///   two              0, 1 = 25, 50 %; 3 = raw (2 unused)                    2 bits
///   burst            number of bursts, the raw block's number = raw         ceil(log2(raw / burst + 1)) bits
struct SizeClasses {
  SizeChoice sizes;
  uint32_t raw_bits;  ///< of a block: 2048 for 32-bit pixels
  uint32_t burst_bits;

  uint32_t csb_bits() const {
    return sizes == SizeChoice::kBurst ? static_cast<uint32_t>(std::bit_width(raw_class())) : 2;
  }
  /// A raw block smaller than a burst still takes one burst.
  uint32_t raw_class() const {
    return sizes == SizeChoice::kBurst ? (raw_bits + burst_bits - 1) / burst_bits : 3;
  }
  /// Returns the class of a stream of `bits`.
  uint32_t class_of(uint32_t bits) const {
    if (sizes == SizeChoice::kBurst) {
      const uint32_t bursts = (bits + burst_bits - 1) / burst_bits;
      return bursts < raw_class() ? bursts : raw_class();
    }
    const uint32_t quarter = raw_bits / 4, largest = sizes == SizeChoice::kTwo ? 2 : 3;
    const uint32_t quarters = (bits + quarter - 1) / quarter;
    return quarters <= largest ? quarters - 1 : raw_class();
  }
  bool valid(uint32_t cls) const {
    if (sizes == SizeChoice::kBurst) return cls >= 1 && cls <= raw_class();
    return cls <= 3 && !(sizes == SizeChoice::kTwo && cls == 2);
  }
  /// Returns the payload bits of a block of this class.
  uint32_t bits_of(uint32_t cls) const {
    if (cls == raw_class()) return raw_bits;
    return sizes == SizeChoice::kBurst ? cls * burst_bits : (cls + 1) * (raw_bits / 4);
  }
};

}  // namespace tilepress
