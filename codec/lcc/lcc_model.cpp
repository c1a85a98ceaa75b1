#include "lcc/lcc_model.h"

#include <numeric>

#include "lcc/lcc_walk.h"

namespace tilepress {
namespace {

/// Adds up and counts the symbols of a block.
struct SymbolSum {
  const LccPlanes& planes;
  const uint8_t* lengths;
  uint32_t* counts;
  uint32_t index_bits;
  uint32_t bits = 0;

  void equal(uint32_t symbol, uint32_t count) {
    counts[symbol] += count;
    bits += lengths[symbol] * count;
  }
  void palette(uint32_t symbol, uint32_t /*index*/) {
    equal(symbol, 1);
    bits += index_bits;
  }
  void residuals(uint32_t symbol, LccToken token, uint32_t pixel) {
    equal(symbol, 1);
    const uint32_t channels = lcc_residual_channels(token);
    equal(planes.symbol[0][pixel] - (channels == 1 ? kLccLumaAlone : 0), 1);
    for (uint32_t c = 1; c < channels; ++c) equal(planes.symbol[c][pixel], 1);
    bits += planes.rest_bits[channels - 1][pixel];
  }
};

}  // namespace

void LccModel::begin_frame() {
  choose_palette();
  choose_codes();
  codes_made_ = false;
  counts_.fill(0);
}

/// A colour of the palette saves some two bits a pixel: a solid block, 64 pixels, saves a burst.
void LccModel::choose_palette() {
  has_palette_ = false;
  if (view_.ccd == nullptr) return;
  const uint64_t covered =
      std::accumulate(ccd().counts.begin(), ccd().counts.end(), uint64_t{0}) * fvc_.sample;
  has_palette_ = 2 * covered > palette_bits();
}

void LccModel::choose_codes() {
  const LccLengths learned = LccLengths::learned(counts_);
  has_codes_ = LccLengths::fixed().bits(counts_) > learned.bits(counts_) + LccLengths::kTableBits;
  lengths_ = has_codes_ ? learned : LccLengths::fixed();
}

const LccCodes& LccModel::codes() const {
  if (!codes_made_) codes_.assign(lengths_);
  codes_made_ = true;
  return codes_;
}

void LccModel::see_block(const BlockContext& block) {
  if (is_solid(block)) return;
  kernels_.find_planes(block.raster().pixels, planes_);
  // Nothing is learned from noise, and from blocks of one colour: the engine may leave one out that it has
  // seen.
  const bool learns = !block.uniform && planes_.estimates < kLccNoise;
  SymbolSum sum{planes_, lengths_.of.data(), learns ? counts_.data() : ignored_.data(), index_bits()};
  lcc_walk(planes_, indices(), index_bits(), sum);
  bits_ = first_pixel_bits(block.pixels[0]) + sum.bits;
}

/// What the head of lcc_scheme.cpp draws.
uint32_t LccModel::first_pixel_bits(uint32_t pixel) const {
  const uint32_t flag = has_palette_ ? 1 : 0;
  if (first_index() != kNotInCcd) return flag + index_bits();
  return flag + 1 + (pixel >> 24 == kLccOpaque ? 24 : 32);
}

LccModel& LccSource::model_of(const FvcConfig& fvc, const CcdView& view) {
  for (LccModel& model : models_)
    if (model.fvc() == fvc) return model;
  return models_.emplace_back(fvc, view);
}

}  // namespace tilepress
