// Block check: encodes a block, decodes it from the bits alone and compares (--verify).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tilepress/scheme.h"

namespace tilepress {

/// Holds the buffers of round trips from block to block.
class BlockCheck {
 public:
  /// Passes the frame's tables from encoder to decoder as bits. Returns false if the decoder refuses them or
  /// the encoder reports another number of bits.
  bool begin_frame(const BlockEncoder& encoder, BlockDecoder& decoder) {
    tables_.assign((encoder.palette_bits() + 7) / 8, 0);
    BitWriter writer(tables_);
    encoder.write_tables(writer);
    writer.flush();
    if (writer.bit_count() != encoder.palette_bits()) return false;
    BitReader reader(tables_, writer.bit_count());
    return decoder.begin_frame(reader, writer.bit_count(), encoder.csb_bits());
  }

  /// Returns true if the decoder restores the block, and both sides use exactly `payload_bits` and csb_bits()
  /// bits.
  bool round_trip(const BlockEncoder& encoder, BlockDecoder& decoder, const BlockContext& block,
                  uint32_t payload_bits) {
    BitWriter payload(payload_), csb(csb_);
    encoder.encode(block, payload, csb);
    payload.flush();
    csb.flush();
    if (payload.bit_count() != payload_bits || csb.bit_count() != encoder.csb_bits() ||
        payload.overflowed() || csb.overflowed())
      return false;
    BitReader payload_in(payload_, payload_bits), csb_in(csb_, csb.bit_count());
    Block decoded;
    decoded.pixels.fill(0xDEADBEEF);  // an earlier block must not pass as this one
    return decoder.decode_at(block.bx, block.by, csb_in, payload_in, decoded) && decoded == block.raster() &&
           payload_in.position() == payload_bits;
  }

 private:
  std::array<uint8_t, kMaxRawBlockBits / 8> payload_{};
  std::array<uint8_t, 16> csb_{};
  std::vector<uint8_t> tables_;
};

}  // namespace tilepress
