// Toy scheme: a whole compression scheme outside the library. It stores the first pixel of a row of eight
// once if the whole row has that colour.
//
//   CSB       8 × 1 bit: 1 = the row is one colour
//   payload   per row: 1 pixel, or 8
#pragma once

#include <algorithm>

#include "tilepress/scheme.h"

namespace toy {

using namespace tilepress;

class Encoder final : public BlockEncoder {
 public:
  Encoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : rows_(spec.number("rows")), bits_(format.pixel_bits) {}
  uint32_t csb_bits() const override { return kBlockSide; }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const Block raster = block.raster();
    for (uint32_t y = 0; y < kBlockSide; ++y) {
      csb.put(solid(raster, y), 1);
      for (uint32_t x = 0; x < (solid(raster, y) ? 1 : kBlockSide); ++x)
        payload.put(raster.pixels[kBlockSide * y + x], bits_);
    }
  }
  void account(const BlockContext& block, uint32_t, SchemeStatistics& statistics) const override {
    for (uint32_t y = 0; y < kBlockSide; ++y) statistics.own[0] += solid(block.raster(), y);
  }

 private:
  bool solid(const Block& raster, uint32_t y) const {
    const auto row = raster.pixels.begin() + kBlockSide * y;
    return y < rows_ && std::count(row, row + kBlockSide, *row) == kBlockSide;
  }
  const uint32_t rows_, bits_;
};

class Decoder final : public BlockDecoder {
 public:
  Decoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&) : bits_(format.pixel_bits) {}
  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kBlockSide;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t* row = out.pixels.data(); row < out.pixels.data() + kBlockPixels; row += kBlockSide) {
      const bool solid = csb.get(1) != 0;
      for (uint32_t x = 0; x < kBlockSide; ++x)
        row[x] = solid && x > 0 ? row[0] : static_cast<uint32_t>(payload.get(bits_));
    }
    return !csb.overran() && !payload.overran();
  }

 private:
  const uint32_t bits_;
};

inline constexpr SchemeKey kKeys[] = {
    {.name = "rows", .summary = "rows that may be stored as one pixel", .low = 1, .high = 8, .initial = 8}};
inline constexpr const char* kColumns[] = {"toy_rows"};
inline constexpr SchemeInfo kInfo = {.name = "toy",
                                     .label = "Toy",
                                     .family = "toy",
                                     .summary = "rows of one colour as one pixel",
                                     .source = "this test",
                                     .make_encoder = make_encoder<Encoder>,
                                     .make_decoder = make_decoder<Decoder>,
                                     .keys = kKeys,
                                     .columns = kColumns};

}  // namespace toy
