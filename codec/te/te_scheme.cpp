// TE: transaction elimination. A 16×16 tile with the checksum of the frame before is not written again.
//
//   CSB       1 bit, the same for the blocks of a tile: 1 = written in this frame, 0 = left as it was
//   payload   written: 64 raw pixels; left: nothing
//   tables    64 bits a tile, tiles in raster order: CRC-64/XZ of its pixels' bytes
//
// Modelling decisions. ARM's Mali GPUs use tiles of 16×16 pixels (four blocks; fewer at the right and bottom
// edge) with one 64-bit checksum each. The function is not public. Here the checksum covers the tile's pixels
// row by row, padding included. Every frame writes its checksums (palette_bits) and reads the checksums of
// the frame before (extra_bits; 0 in a surface's first frame). A real buffer needs no CSB: its unwritten
// tiles stay. The CSB bit makes a block's bits say whether the block changed. Two different tiles may have
// equal checksums; the new tile is lost then, as in the hardware. Random pixels collide once in 2^64, but
// pixels can be made to collide. --verify notices: the decoder keeps the surface that it restored, and the
// engine compares it with the frame.
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "pixels/raw_bits.h"
#include "registry.h"
#include "te/crc64.h"

namespace tilepress {
namespace {

constexpr uint32_t kTileBlocks = 2;  ///< blocks of a tile in each direction
constexpr uint32_t kChecksumBits = 64;

class TeEncoder final : public BlockEncoder {
 public:
  TeEncoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  SchemeNeeds needs() const override { return {.whole_frame = true, .place = true}; }
  void begin_frame(const FrameContext& frame) override {
    std::swap(now_, before_);
    if (frame.ordinal == 0) before_.clear();
    const PixelPlane& plane = frame.plane;
    tiles_x_ = (plane.blocks_x() + kTileBlocks - 1) / kTileBlocks;
    const uint32_t tiles_y = (plane.blocks_y() + kTileBlocks - 1) / kTileBlocks;
    now_.assign(size_t{tiles_x_} * tiles_y, 0);
    constexpr uint32_t kTileSide = kTileBlocks * kBlockSide;
    for (uint32_t y = 0; y < plane.blocks_y() * kBlockSide; ++y)
      for (uint32_t tile = 0; tile < tiles_x_; ++tile) {
        const uint32_t x = tile * kTileSide, width = std::min(kTileSide, plane.padded_width() - x);
        uint64_t& crc = now_[size_t{y / kTileSide} * tiles_x_ + tile];
        crc = crc64({plane.row(y) + x, width}, pixel_bits_ / 8, crc);
      }
  }
  uint32_t csb_bits() const override { return 1; }
  uint64_t palette_bits() const override { return uint64_t{now_.size()} * kChecksumBits; }
  void write_tables(BitWriter& out) const override {
    for (const uint64_t checksum : now_) {
      out.put64(checksum);
    }
  }
  uint32_t measure(const BlockContext& block) const override {
    return written(block) ? kBlockPixels * pixel_bits_ : 0;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    csb.put(written(block), 1);
    if (written(block)) write_raw_block(block.pixels, pixel_bits_, payload);
  }
  void account(const BlockContext& block, uint32_t, SchemeStatistics& statistics) const override {
    const bool first_of_tile = block.bx % kTileBlocks == 0 && block.by % kTileBlocks == 0;
    if (first_of_tile && !before_.empty()) statistics.extra_bits += kChecksumBits;
  }

 private:
  bool written(const BlockContext& block) const {
    const size_t tile = size_t{block.by / kTileBlocks} * tiles_x_ + block.bx / kTileBlocks;
    return before_.empty() || now_[tile] != before_[tile];
  }
  const uint32_t pixel_bits_;
  uint32_t tiles_x_ = 0;
  std::vector<uint64_t> now_, before_;  ///< checksums by tile; before_ is empty in the first frame
};

/// Keeps the blocks restored so far.
class TeDecoder final : public BlockDecoder {
 public:
  TeDecoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  /// Skips the checksums, which only the next frame's encoder uses.
  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    tables.skip(table_bits);
    return csb_bits == 1 && table_bits % kChecksumBits == 0 && !tables.overran();
  }
  /// Returns false for a block that was not written: it has no bits.
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    if (csb.get(1) == 0) return false;
    read_raw_block(payload, pixel_bits_, out);
    return !csb.overran() && !payload.overran();
  }
  bool decode_at(uint32_t bx, uint32_t by, BitReader& csb, BitReader& payload, Block& out) override {
    const auto at = std::pair(by, bx);
    if (csb.get(1) == 0) {
      const auto kept = surface_.find(at);
      if (kept == surface_.end()) return false;
      out = kept->second;
    } else {
      read_raw_block(payload, pixel_bits_, out);
    }
    if (csb.overran() || payload.overran()) return false;
    surface_[at] = out;
    return true;
  }

 private:
  const uint32_t pixel_bits_;
  std::map<std::pair<uint32_t, uint32_t>, Block> surface_;  ///< by block row and column
};

}  // namespace

const SchemeInfo kTeInfo = {.name = "te",
                            .label = "TE",
                            .family = "te",
                            .group = SchemeGroup::kHardware,
                            .summary = "16x16 tiles whose 64-bit checksum did not change are not written",
                            .source = "ARM transaction elimination",
                            .make_encoder = make_encoder<TeEncoder>,
                            .make_decoder = make_decoder<TeDecoder>,
                            .needs_frame_before = true};

}  // namespace tilepress
