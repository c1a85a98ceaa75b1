// Frame accesses: the orders of writing and of showing.
#include "memory_trace/frame_accesses.h"

#include <algorithm>
#include <cstring>

#include "tilepress/tiler.h"

namespace tilepress {
namespace {

class Accesses {
 public:
  Accesses(const CompressedSurface& frame, TracedForm form) : frame_(frame), raw_(form == TracedForm::kRaw) {
    out_.reserve(frame.blocks() + 2);
  }

  void block(uint64_t number) {
    add(SurfacePart::kPayload, number * frame_.slot_bytes(),
        raw_ ? frame_.raw_block_bursts() : bursts(frame_.block_bits[number]));
  }
  /// Bursts [begin, end) of the CSB plane.
  void csb(uint64_t begin, uint64_t end) { add(SurfacePart::kCsb, begin * frame_.burst_bits / 8, end - begin); }
  void tables() { add(SurfacePart::kTables, 0, raw_ ? 0 : bursts(frame_.table_bits)); }

  /// Bursts of the CSB plane up to the entry of block `number`, not included.
  uint64_t csb_bursts_before(uint64_t number) const { return raw_ ? 0 : bursts(number * frame_.csb_bits); }

  std::vector<MemoryFetch> take() { return std::move(out_); }

 private:
  uint64_t bursts(uint64_t bits) const { return (bits + frame_.burst_bits - 1) / frame_.burst_bits; }
  void add(SurfacePart part, uint64_t offset_bytes, uint64_t count) {
    if (count > 0) out_.push_back({part, offset_bytes, count});
  }

  const CompressedSurface& frame_;
  const bool raw_;
  std::vector<MemoryFetch> out_;
};

}  // namespace

std::vector<MemoryFetch> frame_writes(const CompressedSurface& frame, TracedForm form) {
  Accesses out(frame, form);
  const uint32_t blocks_x = frame.blocks_x();
  for_each_block_in_tiles(blocks_x, frame.blocks_y(), frame.tile_side,
                          [&](uint32_t bx, uint32_t by) { out.block(uint64_t{by} * blocks_x + bx); });
  out.csb(0, out.csb_bursts_before(frame.blocks()));
  out.tables();
  return out.take();
}

std::vector<MemoryFetch> display_reads(const CompressedSurface& frame, TracedForm form) {
  Accesses out(frame, form);
  out.tables();
  uint64_t csb_read = 0;
  for (uint64_t number = 0; number < frame.blocks(); ++number) {
    const uint64_t csb_needed = out.csb_bursts_before(number + 1);
    out.csb(csb_read, csb_needed);
    csb_read = csb_needed;
    out.block(number);
  }
  return out.take();
}

void copy_part(const CompressedSurface& frame, SurfacePart part, uint64_t offset_bytes, std::span<uint8_t> out) {
  const uint8_t* bytes = frame.payload.data();
  uint64_t size = frame.payload.size();
  if (part == SurfacePart::kCsb) {
    bytes = frame.csb.data();
    size = frame.csb.size();
  } else if (part == SurfacePart::kTables) {
    bytes = frame.tables.data();
    size = frame.tables.size();
  }
  const uint64_t held = offset_bytes < size ? std::min<uint64_t>(out.size(), size - offset_bytes) : 0;
  if (held > 0) std::memcpy(out.data(), bytes + offset_bytes, held);
  std::fill(out.begin() + static_cast<ptrdiff_t>(held), out.end(), uint8_t{0});
}

}  // namespace tilepress
