// HiLo: the high parts of the block's pixel words are near the least or the greatest (ATTILA GPU simulator).
//
//   CSB       2 bits: the class; 0, 1, 2 = 512, 1024, 1536 bits; 3 = raw
//   payload   |high part of the least word 32 − L|high part of the greatest word 32 − L|
//             |reference 2|low part L| for each pixel in traversal order
//             zeros up to the class; or 64 raw pixels
//   tables    none
//
//   L is 5, 13 and 21 for the classes: 502, 998 and 1494 bits. The high part of a pixel is its reference:
//               0  that of the least word        2  that of the least word, and 1
//               1  that of the greatest word     3  that of the greatest word, less 1
//
// Modelling decisions. The words are R | G<<8 | B<<16 | A<<24, compared as numbers. The smallest class in
// which every pixel has a reference wins; ties of references go to the lowest. The order of the fields is
// ours.
#include <algorithm>

#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kPixelBits = 32, kReferenceBits = 2, kCsbBits = 2;
constexpr uint32_t kLowBits[] = {5, 13, 21};  ///< L by class
constexpr uint32_t kRawClass = 3;

constexpr uint32_t class_bits(uint32_t cls) {
  return (cls + 1) * (kBlockPixels * kPixelBits / 4);
}

/// The high parts that a block may have, by reference.
struct References {
  References(uint32_t least_high, uint32_t greatest_high)
      : high{least_high, greatest_high, least_high + 1, greatest_high - 1} {}
  uint32_t high[4];
  uint32_t find(uint32_t value) const {
    return static_cast<uint32_t>(std::find(high, high + 3, value) - high);
  }
};

struct Range {
  explicit Range(const uint32_t* pixels) : least(pixels[0]), greatest(pixels[0]) {
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      least = std::min(least, pixels[i]);
      greatest = std::max(greatest, pixels[i]);
    }
  }
  uint32_t least, greatest;
};

/// True if every pixel's high part is at most 1 from the least or from the greatest.
bool all_near(const uint32_t* pixels, const Range& range, uint32_t low_bits) {
  const uint32_t least = range.least >> low_bits, greatest = range.greatest >> low_bits;
  uint32_t far = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t high = pixels[i] >> low_bits;
    far |= (high - least) >> 1 != 0 ? (greatest - high) >> 1 : 0;
  }
  return far == 0;
}

uint32_t class_of(const BlockContext& block, const Range& range) {
  if (block.uniform) return 0;
  uint32_t cls = 0;
  while (cls < kRawClass && !all_near(block.pixels, range, kLowBits[cls])) ++cls;
  return cls;
}

class HiloEncoder final : public BlockEncoder {
 public:
  HiloEncoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  uint32_t csb_bits() const override { return kCsbBits; }
  uint32_t measure(const BlockContext& block) const override {
    return class_bits(block.uniform ? 0 : class_of(block, Range(block.pixels)));
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const Range range(block.pixels);
    const uint32_t cls = class_of(block, range);
    csb.put(cls, kCsbBits);
    if (cls == kRawClass) return write_raw_block(block.pixels, kPixelBits, payload);
    const uint32_t low_bits = kLowBits[cls];
    const uint64_t end = payload.bit_count() + class_bits(cls);
    const References references(range.least >> low_bits, range.greatest >> low_bits);
    payload.put(references.high[0], kPixelBits - low_bits);
    payload.put(references.high[1], kPixelBits - low_bits);
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      payload.put(references.find(block.pixels[i] >> low_bits), kReferenceBits);
      payload.put(block.pixels[i] & ((1u << low_bits) - 1), low_bits);
    }
    payload.pad_to(end);
  }
};

class HiloDecoder final : public BlockDecoder {
 public:
  HiloDecoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kCsbBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto cls = static_cast<uint32_t>(csb.get(kCsbBits));
    if (cls == kRawClass) {
      read_raw_block(payload, kPixelBits, out);
      return !csb.overran() && !payload.overran();
    }
    const uint32_t low_bits = kLowBits[cls];
    const uint64_t end = payload.position() + class_bits(cls);
    const auto least = static_cast<uint32_t>(payload.get(kPixelBits - low_bits));
    const auto greatest = static_cast<uint32_t>(payload.get(kPixelBits - low_bits));
    const References references(least, greatest);
    for (const uint8_t place : kTraversal) {
      const uint32_t high = references.high[payload.get(kReferenceBits)];
      out.pixels[place] = high << low_bits | static_cast<uint32_t>(payload.get(low_bits));
    }
    payload.skip(end - payload.position());
    return least <= greatest && !csb.overran() && !payload.overran();
  }
};

}  // namespace

const SchemeInfo kHiloInfo = {.name = "hilo",
                              .label = "HiLo",
                              .family = "attila",
                              .group = SchemeGroup::kLiterature,
                              .summary = "pixel words whose high parts are near the least or the greatest",
                              .source = "ATTILA GPU simulator",
                              .make_encoder = make_encoder<HiloEncoder>,
                              .make_decoder = make_decoder<HiloDecoder>,
                              .eight_bit_only = true};

}  // namespace tilepress
