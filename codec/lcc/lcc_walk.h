// LCC walk: the symbols of pixels 1 to 63 of a block, in the order in which they are coded.
#pragma once

#include <cstdint>
#include <cstring>

#include "dcp/ccd_view.h"
#include "lcc/lcc_planes.h"

namespace tilepress {

/// Raster positions to traversal positions.
constexpr LccPlane<uint8_t> make_lcc_places() {
  LccPlane<uint8_t> places{};
  for (uint32_t i = 0; i < kBlockPixels; ++i) places[kTraversal[i]] = static_cast<uint8_t>(i);
  return places;
}
constexpr LccPlane<uint8_t> kLccPlaces = make_lcc_places();

/// Calls, pixel by pixel,
///   visit.equal(symbol, count)             for `count` pixels that equal a neighbour
///   visit.palette(symbol, index)           for a colour of the CCD
///   visit.residuals(symbol, token, pixel)  for residuals, which are in the planes at `pixel`
/// `indices` has the CCD's indices in traversal order, kNotInCcd where the CCD lacks the colour. It is null
/// for a frame without palette.
template <class Visit>
void lcc_walk(const LccPlanes& planes, const uint16_t* indices, uint32_t index_bits, Visit&& visit) {
  constexpr uint32_t kFlat = lcc_token_symbol(0, 0, LccToken::kLeft);
  static_assert(lcc_number(LccToken::kLeft) == 0);
  uint8_t is_residual[kBlockSide] = {};  // the pixel above, or that at hand
  uint8_t last_is_residual = 0;
  for (uint32_t i = 1; i < kBlockPixels; ++i) {
    const uint32_t x = i % kBlockSide;
    if (x == 0) {  // a row inside an area of one colour at once
      uint64_t tokens, shapes, above;
      std::memcpy(&tokens, &planes.token[i], 8);
      std::memcpy(&shapes, &planes.shape[i], 8);
      std::memcpy(&above, is_residual, 8);
      if ((tokens | shapes | above) == 0) {
        visit.equal(kFlat, kBlockSide);
        last_is_residual = 0;
        i += kBlockSide - 1;
        continue;
      }
    }
    const uint8_t above = i < kBlockSide ? last_is_residual : is_residual[x];
    const uint32_t beside = uint32_t{above} + (x == 0 ? above : last_is_residual);
    last_is_residual = is_residual[x] = 0;
    const auto token = static_cast<LccToken>(planes.token[i]);
    if (token != LccToken::kPalette) {
      visit.equal(lcc_token_symbol(planes.shape[i], beside, token), 1);
      continue;
    }
    const uint32_t index = indices == nullptr ? kNotInCcd : indices[kLccPlaces[i]];
    if (index != kNotInCcd && planes.estimate[i] > index_bits + kLccPaletteMargin) {
      visit.palette(lcc_token_symbol(planes.shape[i], beside, token), index);
      continue;
    }
    last_is_residual = is_residual[x] = 1;
    const auto residual = static_cast<LccToken>(planes.residual[i]);
    visit.residuals(lcc_token_symbol(planes.shape[i], beside, residual), residual, i);
  }
}

}  // namespace tilepress
