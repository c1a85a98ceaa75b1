// Intel8: the colour compression (CCS) of Intel's 8th generation, as reverse engineered by Wang et al.
//
//   CSB       2 bits for each pair of memory lines (8×4 pixels): 0 = raw, 1 = compressed
//   payload   the pairs in order, rows 0–3, then rows 4–7
//             compressed, 512 bits, filled from the low end of each byte:
//               |constant R|G|B|A|               1 bit each: the channel equals its base everywhere
//               |base R 8|G 8|B 8|A 8|
//               |width R 3|G 3|B 3|A 3|          bits of a difference, less 1; 0 for a constant channel
//               32 × |dR|dG|dB|dA|0 …|           14 bits a pixel: value = base + d, then zeros; the left 4×4
//                                                line row by row, then the right line
//               |0 16|
//             raw, 1024 bits: the same order, 4 bytes R, G, B, A a pixel
//   tables    none
//
// Modelling decisions. The format is known from the published decoder, not from Intel. A pair is compressed
// whenever the widths of its channels sum to at most 14: how the hardware decides is unknown, so the sizes
// are a bound. Each base is the channel's smallest value. The sources leave open what the two metadata bits
// mean: their values are ours.
#include "intel/byte_ranges.h"
#include "intel/pixel_pair.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kStatusBits = 2;
constexpr uint32_t kRawPair = 0, kCompressedPair = 1;
constexpr uint32_t kChannels = 4;
constexpr uint32_t kPixelBits = 14;
constexpr uint32_t kCompressedBytes = 64;

ByteRanges pair_ranges(const uint32_t* pair) {
  return united(byte_ranges(pair, pair + 8), byte_ranges(pair + 16, pair + 24));
}

bool fits(const ByteRanges& ranges) {
  return ranges.width(0) + ranges.width(1) + ranges.width(2) + ranges.width(3) <= kPixelBits;
}

void write_pair(const uint32_t* pair, const ByteRanges& ranges, BitWriter& out) {
  LowFirstBits bits;
  for (uint32_t c = 0; c < kChannels; ++c) bits.put(ranges.width(c) == 0, 1);
  for (uint32_t c = 0; c < kChannels; ++c) bits.put(ranges.low[c], 8);
  for (uint32_t c = 0; c < kChannels; ++c) bits.put(ranges.width(c) == 0 ? 0 : ranges.width(c) - 1, 3);
  for (uint32_t i = 0; i < kPairPixels; ++i) {
    const uint32_t pixel = pair[row_position(i / kPairLinePixels, i % kPairLinePixels)];
    uint32_t left = kPixelBits;
    for (uint32_t c = 0; c < kChannels; ++c) {
      bits.put((pixel >> 8 * c & 0xFF) - ranges.low[c], ranges.width(c));
      left -= ranges.width(c);
    }
    bits.put(0, left);
  }
  bits.write(out, kCompressedBytes);
}

/// Returns false if no encoder writes these bits.
bool read_pair(BitReader& in, uint32_t* pair) {
  LowFirstBits bits = LowFirstBits::read(in, kCompressedBytes);
  uint32_t widths[kChannels], bases[kChannels], sum = 0;
  const uint32_t constant = bits.get(kChannels);
  for (uint32_t& base : bases) base = bits.get(8);
  for (uint32_t c = 0; c < kChannels; ++c) {
    widths[c] = bits.get(3);
    const bool is_constant = (constant >> c & 1) != 0;
    if (is_constant && widths[c] != 0) return false;
    if (!is_constant) ++widths[c];
    sum += widths[c];
  }
  if (sum > kPixelBits) return false;
  for (uint32_t i = 0; i < kPairPixels; ++i) {
    uint32_t pixel = 0;
    for (uint32_t c = 0; c < kChannels; ++c) pixel |= ((bases[c] + bits.get(widths[c])) & 0xFF) << 8 * c;
    pair[row_position(i / kPairLinePixels, i % kPairLinePixels)] = pixel;
    bits.skip(kPixelBits - sum);
  }
  return true;
}

class Intel8Encoder final : public BlockEncoder {
 public:
  Intel8Encoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  uint32_t csb_bits() const override { return kPairs * kStatusBits; }
  uint32_t measure(const BlockContext& block) const override {
    uint32_t bits = 0;
    for (uint32_t pair = 0; pair < kPairs; ++pair)
      bits += fits(pair_ranges(block.pixels + pair * kPairPixels)) ? kCompressedBytes * 8
                                                                   : kPairLines * kRawLineBits;
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t i = 0; i < kPairs; ++i) {
      const uint32_t* pair = block.pixels + i * kPairPixels;
      const ByteRanges ranges = pair_ranges(pair);
      csb.put(fits(ranges) ? kCompressedPair : kRawPair, kStatusBits);
      if (fits(ranges)) {
        write_pair(pair, ranges, payload);
      } else {
        for (uint32_t line = 0; line < kPairLines; ++line) write_raw_pair_line(pair, line, payload);
      }
    }
  }
};

class Intel8Decoder final : public BlockDecoder {
 public:
  Intel8Decoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kPairs * kStatusBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t i = 0; i < kPairs; ++i) {
      uint32_t pair[kPairPixels];
      const uint64_t status = csb.get(kStatusBits);
      if (status == kRawPair) {
        for (uint32_t line = 0; line < kPairLines; ++line) read_raw_pair_line(payload, line, pair);
      } else if (status != kCompressedPair || !read_pair(payload, pair)) {
        return false;
      }
      place_pair(pair, i, out);
    }
    return !csb.overran() && !payload.overran();
  }
};

}  // namespace

const SchemeInfo kIntel8Info = {
    .name = "intel8",
    .label = "Intel 8",
    .family = "intel",
    .group = SchemeGroup::kHardware,
    .summary = "Intel's 8th-generation CCS, as reverse engineered: 8x4 pixels in 64 or 128 bytes",
    .source = "Wang et al. 2024 (GPU.zip), as reverse engineered",
    .make_encoder = make_encoder<Intel8Encoder>,
    .make_decoder = make_decoder<Intel8Decoder>,
    .eight_bit_only = true};

}  // namespace tilepress
