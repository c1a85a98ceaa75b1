// Bus toggles: walks a frame in the order of its writes and counts the wires that change.
#include "memory/bus_toggles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "tilepress/tiler.h"

namespace tilepress {
namespace {

/// Sends the bytes, and zeros up to whole bursts.
void send_padded(std::span<const uint8_t> bytes, size_t burst_bytes, MemoryBus& bus) {
  const size_t whole = bytes.size() / burst_bytes * burst_bytes;
  bus.send(bytes.first(whole));
  if (whole == bytes.size()) return;
  std::vector<uint8_t> last(burst_bytes);
  std::copy(bytes.begin() + static_cast<ptrdiff_t>(whole), bytes.end(), last.begin());
  bus.send(last);
}

}  // namespace

void MemoryBus::send(std::span<const uint8_t> bytes) {
  for (size_t at = 0; at < bytes.size(); at += beat_bytes_) {
    uint32_t beat = 0, lanes = 0;
    for (uint32_t lane = 0; lane < beat_bytes_; ++lane) {
      const uint32_t byte = bytes[at + lane];
      beat |= byte << 8 * lane;
      const uint32_t sent = lanes_ >> 8 * lane & 0xFF;
      const auto changes = static_cast<uint32_t>(std::popcount(byte ^ sent));
      const bool inverts = changes > 4;
      lanes |= (inverts ? byte ^ 0xFF : byte) << 8 * lane;
      inverted_ += (inverts ? 8 - changes : changes) + (inverts != (dbi_[lane] != 0));
      dbi_[lane] = inverts;
    }
    plain_ += static_cast<uint32_t>(std::popcount(beat ^ before_));
    before_ = beat;
    lanes_ = lanes;
  }
}

void send_surface(const CompressedSurface& surface, MemoryBus& bus) {
  const size_t burst_bytes = surface.burst_bits / 8;
  const std::span<const uint8_t> payload = surface.payload;
  for_each_block_in_tiles(
      surface.blocks_x(), surface.blocks_y(), surface.tile_side, [&](uint32_t bx, uint32_t by) {
        const uint64_t number = uint64_t{by} * surface.blocks_x() + bx;
        const size_t bursts = (surface.block_bits[number] + surface.burst_bits - 1) / surface.burst_bits;
        bus.send(payload.subspan(number * surface.slot_bytes(), bursts * burst_bytes));
      });
  send_padded(surface.csb, burst_bytes, bus);
  send_padded(surface.tables, burst_bytes, bus);
}

void send_raw(const PixelPlane& plane, uint32_t tile_side, uint32_t burst_bits, MemoryBus& bus) {
  const uint32_t pixel_bytes = traits(plane.format()).pixel_bits / 8;
  std::array<uint8_t, kMaxRawBlockBits / 8> bytes;
  for_each_block_in_tiles(plane.blocks_x(), plane.blocks_y(), tile_side, [&](uint32_t bx, uint32_t by) {
    Block block;
    plane.load_block(bx, by, block);
    size_t at = 0;
    for (const auto place : kTraversal)
      for (uint32_t byte = 0; byte < pixel_bytes; ++byte)
        bytes[at++] = static_cast<uint8_t>(block.pixels[place] >> 8 * byte);
    send_padded({bytes.data(), at}, burst_bits / 8, bus);
  });
}

}  // namespace tilepress
