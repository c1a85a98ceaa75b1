// Bus toggles: how many wires of the memory bus change while a frame is written.
#pragma once

#include <cstdint>
#include <span>

#include "tilepress/compressed_surface.h"
#include "tilepress/plane.h"

namespace tilepress {

/// A memory bus of W wires, all zero at first. A beat is W/8 bytes in address order.
class MemoryBus {
 public:
  /// Precondition: `width_bits` is 16 or 32.
  explicit MemoryBus(uint32_t width_bits) : beat_bytes_(width_bits / 8) {}

  /// Sends `bytes`, whole beats.
  void send(std::span<const uint8_t> bytes);
  /// Wires that changed between a beat and the next, summed over the beats.
  uint64_t toggles() const { return plain_; }
  /// The same with data bus inversion: a byte lane sends the inverted byte if more than four of its data
  /// wires would change. The lane's DBI wire counts like a data wire.
  uint64_t toggles_with_inversion() const { return inverted_; }

 private:
  const uint32_t beat_bytes_;
  uint32_t before_ = 0;  ///< the beat before, byte lane 0 in the low bits
  uint32_t lanes_ = 0;   ///< what the lanes sent with inversion
  uint8_t dbi_[4] = {};  ///< each lane's DBI wire
  uint64_t plain_ = 0, inverted_ = 0;
};

/// Writes a surface over the bus in the order of a memory trace: blocks in traversal order, each the whole
/// bursts that its payload fills, then the CSB plane and the tables in whole bursts.
void send_surface(const CompressedSurface& surface, MemoryBus& bus);
/// The same for the frame without compression: each block's pixels in traversal order, as memory holds them.
void send_raw(const PixelPlane& plane, uint32_t tile_side, uint32_t burst_bits, MemoryBus& bus);

}  // namespace tilepress
