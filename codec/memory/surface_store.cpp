// Surface store: slots are written in place; CSB bits are merged, as blocks share bytes.
#include "memory/surface_store.h"

#include <cassert>
#include <cstring>
#include <span>

namespace tilepress {
namespace {

constexpr uint32_t kMaxCsbBytes = 32;

/// ORs `bits` bits of `from` into `plane` at bit `position`.
void merge_bits(std::span<const uint8_t> from, uint32_t bits, std::vector<uint8_t>& plane,
                uint64_t position) {
  BitReader reader(from, bits);
  while (bits > 0) {
    const uint64_t byte = position / 8;
    const auto in_byte = static_cast<uint32_t>(position % 8);
    const bool word_fits = byte + 8 <= plane.size();
    const uint32_t room = word_fits ? kMaxBitsPerCall : 8 - in_byte;
    const uint32_t take = bits < room ? bits : room;
    const uint64_t value = reader.get(take);
    if (word_fits) {
      uint64_t word;
      std::memcpy(&word, &plane[byte], 8);
      word |= bit_io::big_endian(value << (64 - in_byte - take));
      std::memcpy(&plane[byte], &word, 8);
    } else {
      plane[byte] |= static_cast<uint8_t>(value << (8 - in_byte - take));
    }
    position += take;
    bits -= take;
  }
}

}  // namespace

void SurfaceStore::begin_frame(const SchemeSpec& spec, const ModelOptions& options, const FrameContext& frame,
                               const BlockEncoder& encoder, CompressedSurface& out) {
  surface_ = &out;
  out.scheme = spec;
  out.format = frame.plane.format();
  out.width = frame.plane.width();
  out.height = frame.plane.height();
  out.ordinal = frame.ordinal;
  out.tile_side = options.tile_side;
  out.burst_bits = options.burst_bits;
  out.csb_bits = encoder.csb_bits();
  out.table_bits = encoder.palette_bits();
  // Slots are kept from the frame before: put() empties what a block used then and does not use now.
  if (out.payload.size() != out.blocks() * out.slot_bytes() || out.block_bits.size() != out.blocks()) {
    out.payload.assign(out.blocks() * out.slot_bytes(), 0);
    out.block_bits.assign(out.blocks(), 0);
  }
  out.csb.assign((out.csb_plane_bits() + 7) / 8, 0);
  out.tables.assign((out.table_bits + 7) / 8, 0);
  BitWriter tables(out.tables);
  encoder.write_tables(tables);
  tables.flush();
  assert(tables.bit_count() == out.table_bits);
}

void SurfaceStore::put(const BlockEncoder& encoder, const BlockContext& block) {
  CompressedSurface& out = *surface_;
  const uint64_t number = uint64_t{block.by} * out.blocks_x() + block.bx;
  std::array<uint8_t, kMaxCsbBytes> csb_bytes;
  const auto slot = std::span(out.payload).subspan(number * out.slot_bytes(), out.slot_bytes());
  if (number + 1 < out.blocks())
    __builtin_prefetch(slot.data() + out.slot_bytes(), 1);  // most often the next
  BitWriter payload(slot);
  BitWriter csb(csb_bytes);
  encoder.encode(block, payload, csb);
  payload.flush();
  csb.flush();
  assert(!payload.overflowed() && !csb.overflowed() && csb.bit_count() == out.csb_bits);
  const size_t used_bytes = (payload.bit_count() + 7) / 8, used_before = (out.block_bits[number] + 7u) / 8;
  if (used_bytes < used_before) std::memset(&slot[used_bytes], 0, used_before - used_bytes);
  out.block_bits[number] = static_cast<uint16_t>(payload.bit_count());
  merge_bits(csb_bytes, out.csb_bits, out.csb, number * out.csb_bits);
}

}  // namespace tilepress
