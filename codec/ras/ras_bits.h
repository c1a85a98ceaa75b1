// RAS bits: the length of each block's RAS stream, the shared analysis of the RAS family.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ras/ras_stream.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Counts a block anew only if its pixels changed since the frame before.
class RasBits final : public BlockAnalysis {
 public:
  explicit RasBits(const FormatTraits& format) : format_(format) {
    for (const bool ycocg : {false, true})
      streams_[ycocg].beside_groups = ras_bits_beside_groups(format, ycocg);
  }

  /// Subscribes to the stream of the RGBA or the YCoCg-R planes. The number referred to is the
  /// stream's bits of the block at hand, before padding to a size class.
  const uint32_t& subscribe(bool ycocg) {
    streams_[ycocg].wanted = true;
    return streams_[ycocg].bits;
  }
  bool wants_changes() const override { return true; }
  void begin_frame(const FrameContext& frame) override {
    plane_ = &frame.plane;
    changed_blocks_ = frame.changed_blocks;
    for (Stream& stream : streams_)
      if (stream.wanted) stream.known.resize(plane_->blocks());
  }
  void see_block(const BlockContext& block) override {
    for (const bool ycocg : {false, true})
      if (Stream& stream = streams_[ycocg]; stream.wanted)
        stream.bits =
            static_cast<uint32_t>(stream.beside_groups + (block.uniform ? 4 * int32_t{kRasZeroPlaneBits}
                                                                        : count(block, ycocg, stream.known)));
  }

 private:
  struct Stream {
    bool wanted = false;
    uint32_t bits = 0;
    int32_t beside_groups = 0;
    std::vector<uint16_t> known;  ///< ras_group_bits by block, but not for blocks of one colour
  };
  int32_t count(const BlockContext& block, bool ycocg, std::vector<uint16_t>& known) const {
    const size_t number = size_t{block.by} * plane_->blocks_x() + block.bx;
    if (changed_blocks_[number] != 0) {
      const uint32_t* top_left = plane_->row(block.by * kBlockSide) + block.bx * kBlockSide;
      known[number] = static_cast<uint16_t>(ras_group_bits(top_left, plane_->stride(), format_, ycocg));
    }
    return known[number];
  }
  const FormatTraits format_;
  const PixelPlane* plane_ = nullptr;
  const uint8_t* changed_blocks_ = nullptr;
  std::array<Stream, 2> streams_;
};

}  // namespace tilepress
