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
  Encoder(const SchemeSpec& spec, const FormatTraits& format)
      : rows_(spec.number("rows")), bits_(format.pixel_bits) {}
  SchemeNeeds needs() const override { return {.raster = true, .raster_to_encode = true}; }
  uint32_t csb_bits() const override { return kBlockSide; }
  uint32_t measure(const BlockContext& block) const override {
    return bits_ * (kBlockPixels - (kBlockSide - 1) * solid_rows(block));
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t y = 0; y < kBlockSide; ++y) {
      csb.put(solid(block, y), 1);
      for (uint32_t x = 0; x < (solid(block, y) ? 1 : kBlockSide); ++x)
        payload.put(block.block.pixels[kBlockSide * y + x], bits_);
    }
  }
  void account(const BlockContext& block, uint32_t, SchemeStatistics& statistics) const override {
    statistics.own[0] += solid_rows(block);
  }

 private:
  bool solid(const BlockContext& block, uint32_t y) const {
    const auto row = block.block.pixels.begin() + kBlockSide * y;
    return y < rows_ && std::count(row, row + kBlockSide, *row) == kBlockSide;
  }
  uint32_t solid_rows(const BlockContext& block) const {
    uint32_t count = 0;
    for (uint32_t y = 0; y < kBlockSide; ++y) count += solid(block, y);
    return count;
  }
  const uint32_t rows_, bits_;
};

class Decoder final : public BlockDecoder {
 public:
  explicit Decoder(const FormatTraits& format) : bits_(format.pixel_bits) {}
  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kBlockSide;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t y = 0; y < kBlockSide; ++y) {
      const bool solid = csb.get(1) != 0;
      for (uint32_t x = 0; x < kBlockSide; ++x)
        out.pixels[kBlockSide * y + x] =
            solid && x > 0 ? out.pixels[kBlockSide * y] : static_cast<uint32_t>(payload.get(bits_));
    }
    return !csb.overran() && !payload.overran();
  }

 private:
  const uint32_t bits_;
};

inline constexpr SchemeKey kKeys[] = {{.name = "rows",
                                       .kind = KeyKind::kNumber,
                                       .values = "1 ... 8",
                                       .standard = "8",
                                       .summary = "rows that may be stored as one pixel",
                                       .low = 1,
                                       .high = 8,
                                       .initial = 8}};
inline constexpr const char* kColumns[] = {"toy_rows"};
inline constexpr SchemeInfo kInfo = {
    .name = "toy",
    .label = "Toy",
    .family = "toy",
    .summary = "rows of one colour as one pixel",
    .source = "this test",
    .make_encoder = [](const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
        -> std::unique_ptr<BlockEncoder> { return std::make_unique<Encoder>(spec, format); },
    .make_decoder = [](const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
        -> std::unique_ptr<BlockDecoder> { return std::make_unique<Decoder>(format); },
    .keys = kKeys,
    .columns = kColumns};

}  // namespace toy
