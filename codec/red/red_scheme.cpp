// RED: uniform 4×2 or 2×2 regions, chosen for the whole block (paper §Surface compression techniques).
//
//   CSB       2 bits: 0 = eight 4×2 regions, 1 = sixteen 2×2 regions, 2 = raw
//   payload   one colour per region, regions in raster order; or 64 raw pixels
//   tables    none
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

enum RedMode : uint32_t { kRegions4x2 = 0, kRegions2x2 = 1, kRaw = 2 };

uint32_t region_width(uint32_t mode) {
  return mode == kRegions4x2 ? 4 : 2;
}

/// A 2×2 region is a sub-block, a 4×2 region two of them side by side.
uint32_t red_mode(const BlockContext& block) {
  if (block.uniform) return kRegions4x2;
  uint32_t mode = kRegions4x2;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint32_t* pixels = block.pixels + sub * kSubBlockPixels;
    if (((pixels[0] ^ pixels[1]) | (pixels[0] ^ pixels[2]) | (pixels[0] ^ pixels[3])) != 0) return kRaw;
    if (sub % 2 == 1 && pixels[0] != pixels[-1]) mode = kRegions2x2;
  }
  return mode;
}

class RedEncoder final : public BlockEncoder {
 public:
  RedEncoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  uint32_t csb_bits() const override { return 2; }
  uint32_t measure(const BlockContext& block) const override {
    constexpr uint32_t kColors[] = {8, 16, 64};
    return kColors[red_mode(block)] * pixel_bits_;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const uint32_t mode = red_mode(block);
    csb.put(mode, 2);
    if (mode == kRaw) return write_raw_block(block.pixels, pixel_bits_, payload);
    for (uint32_t sub = 0; sub < kSubBlocks; sub += region_width(mode) / kSubBlockSide)
      payload.put(block.pixels[sub * kSubBlockPixels], pixel_bits_);
  }

 private:
  const uint32_t pixel_bits_;
};

class RedDecoder final : public BlockDecoder {
 public:
  RedDecoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == 2;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto mode = static_cast<uint32_t>(csb.get(2));
    if (mode > kRaw) return false;
    if (mode == kRaw) {
      read_raw_block(payload, pixel_bits_, out);
    } else {
      const uint32_t width = region_width(mode);
      for (uint32_t y = 0; y < kBlockSide; y += 2)
        for (uint32_t x = 0; x < kBlockSide; x += width) {
          const auto color = static_cast<uint32_t>(payload.get(pixel_bits_));
          for (uint32_t i = 0; i < width; ++i)
            out.pixels[8 * y + x + i] = out.pixels[8 * (y + 1) + x + i] = color;
        }
    }
    return !csb.overran() && !payload.overran();
  }

 private:
  const uint32_t pixel_bits_;
};

}  // namespace

const SchemeInfo kRedInfo = {.name = "red",
                             .label = "RED",
                             .family = "red",
                             .group = SchemeGroup::kPaper,
                             .summary = "uniform 4x2 regions 8:1, else uniform 2x2 regions 4:1, else raw",
                             .source = "NVIDIA, as described in Gubran et al.",
                             .make_encoder = make_encoder<RedEncoder>,
                             .make_decoder = make_decoder<RedDecoder>};

}  // namespace tilepress
