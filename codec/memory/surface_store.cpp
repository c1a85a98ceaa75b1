// Surface store: slots are written in place; CSB bits are merged, as blocks share bytes.
#include "memory/surface_store.h"

#include <cassert>
#include <span>

namespace tilepress {
namespace {

constexpr uint32_t kMaxCsbBytes = 32;

/// ORs `bits` bits of `from` into `plane` at bit `position`.
void merge_bits(std::span<const uint8_t> from, uint32_t bits, std::vector<uint8_t>& plane,
                uint64_t position) {
  BitReader reader(from, bits);
  while (bits > 0) {
    const auto in_byte = static_cast<uint32_t>(position % 8);
    const uint32_t take = bits < 8 - in_byte ? bits : 8 - in_byte;
    plane[position / 8] |= static_cast<uint8_t>(reader.get(take) << (8 - in_byte - take));
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
  out.payload.assign(out.blocks() * out.slot_bytes(), 0);
  out.csb.assign((out.csb_plane_bits() + 7) / 8, 0);
  out.tables.assign((out.table_bits + 7) / 8, 0);
  out.block_bits.assign(out.blocks(), 0);
  BitWriter tables(out.tables);
  encoder.write_tables(tables);
  tables.flush();
  assert(tables.bit_count() == out.table_bits);
}

void SurfaceStore::put(const BlockEncoder& encoder, const BlockContext& block) {
  CompressedSurface& out = *surface_;
  const uint64_t number = uint64_t{block.by} * out.blocks_x() + block.bx;
  std::array<uint8_t, kMaxCsbBytes> csb_bytes{};
  BitWriter payload(std::span(out.payload).subspan(number * out.slot_bytes(), out.slot_bytes()));
  BitWriter csb(csb_bytes);
  encoder.encode(block, payload, csb);
  payload.flush();
  csb.flush();
  assert(!payload.overflowed() && !csb.overflowed() && csb.bit_count() == out.csb_bits);
  out.block_bits[number] = static_cast<uint16_t>(payload.bit_count());
  merge_bits(csb_bytes, out.csb_bits, out.csb, number * out.csb_bits);
}

}  // namespace tilepress
