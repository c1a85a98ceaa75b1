// LCC planes: what the symbols of a block depend on, for all its pixels at once. The loops are plain, so that
// a compiler makes SIMD code of them for each target.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "lcc/lcc_symbols.h"

namespace tilepress {

template <class T>
using LccPlane = std::array<T, kBlockPixels>;  ///< in raster order; pixel 0 has no meaning

struct LccPlanes {
  LccPlane<uint8_t> token;                     ///< an equal neighbour, or kPalette if there is none
  LccPlane<uint8_t> shape;                     ///< of the neighbourhood
  LccPlane<uint8_t> residual;                  ///< the token if the pixel is coded as residuals
  LccPlane<uint8_t> estimate;                  ///< bits of these residuals, see kLccPaletteMargin
  uint32_t estimates;                          ///< their sum over pixels without an equal neighbour
  std::array<LccPlane<uint8_t>, 4> folded;     ///< residuals by channel
  std::array<LccPlane<uint16_t>, 4> symbol;    ///< their classes; see lcc_class_symbol about luma
  std::array<LccPlane<uint8_t>, 4> rest_bits;  ///< the bits after the classes of this channel and all before
};

namespace lcc {

/// Each pixel's neighbours. Row 0 and columns 0 and 7 differ from a shift of the plane: see LccNeighbors.
template <class T>
struct Neighbors {
  LccPlane<T> left, above, above_left, above_right;

  [[gnu::always_inline]] explicit Neighbors(const LccPlane<T>& own) {
    const auto shift = [&](LccPlane<T>& out, uint32_t by) {
      std::memcpy(&out[1], own.data(), 7 * sizeof(T));
      std::memcpy(&out[8], own.data() + 8 - by, 56 * sizeof(T));
      out[0] = own[0];
    };
    shift(left, 1);
    shift(above, 8);
    std::memcpy(&above_left[9], own.data(), 55 * sizeof(T));
    std::memcpy(&above_left[1], own.data(), 7 * sizeof(T));
    above_left[0] = own[0];
    shift(above_right, 7);
    for (uint32_t i = 8; i < kBlockPixels; i += 8) {
      left[i] = above_left[i] = own[i - 8];
      above_right[i + 7] = own[i - 1];
    }
  }
};

[[gnu::always_inline]] inline void find_tokens(const LccPlane<uint32_t>& own, LccPlane<int16_t>& gradients,
                                               LccPlanes& out) {
  const Neighbors<uint32_t> beside(own);
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t left = beside.left[i], above = beside.above[i], above_left = beside.above_left[i],
                   above_right = beside.above_right[i];
    // A cascade without branches, from the last choice to the first.
    uint32_t token =
        own[i] == above_right ? lcc_number(LccToken::kAboveRight) : lcc_number(LccToken::kPalette);
    token = own[i] == above_left ? lcc_number(LccToken::kAboveLeft) : token;
    token = own[i] == above ? lcc_number(LccToken::kAbove) : token;
    token = own[i] == left ? lcc_number(LccToken::kLeft) : token;
    out.token[i] = static_cast<uint8_t>(token);
    out.shape[i] = static_cast<uint8_t>(lcc_shape(left, above, above_left, above_right, gradients[i]));
  }
}

template <uint32_t kChannel>
[[gnu::always_inline]] inline void find_residuals(const LccPlane<int16_t>& own, LccPlane<int16_t>& gradients,
                                                  LccPlanes& out) {
  constexpr uint32_t kBefore = kChannel == 0 ? 0 : kChannel - 1;
  const Neighbors<int16_t> beside(own);
  LccPlane<uint8_t> gradient_class;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const int16_t left = beside.left[i], above = beside.above[i], above_left = beside.above_left[i];
    const auto e = static_cast<int8_t>(own[i] - lcc_predict(left, above, above_left));
    out.folded[kChannel][i] = static_cast<uint8_t>(e * 2 ^ e >> 7);
    const int16_t gradient = lcc_gradient(left, above, above_left);
    gradient_class[i] = lcc_gradient_class(gradient);
    if constexpr (kChannel != kLccAlpha) gradients[i] = static_cast<int16_t>(gradients[i] + gradient);
  }
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint8_t number = lcc_class(out.folded[kChannel][i]), before = out.folded[kBefore][i];
    out.symbol[kChannel][i] =
        static_cast<uint16_t>(lcc_class_symbol(kChannel, gradient_class[i], before) + number);
    const uint8_t bits_before = kChannel == 0 ? uint8_t{0} : out.rest_bits[kBefore][i];
    out.rest_bits[kChannel][i] = static_cast<uint8_t>(bits_before + lcc_bits_after(number));
  }
}

[[gnu::always_inline]] inline void find_residual_tokens(LccPlanes& out) {
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    // 1 where the token has residuals of the colours, of alpha.
    const uint8_t alpha = out.folded[3][i] != 0;
    const uint8_t color = (out.folded[1][i] | out.folded[2][i] | out.folded[3][i]) != 0;
    out.residual[i] = static_cast<uint8_t>(lcc_number(LccToken::kLuma) + color + alpha);
    const auto luma_bits = static_cast<uint8_t>(1 + lcc_size(out.folded[0][i]));
    const auto color_bits = static_cast<uint8_t>(2 + lcc_size(out.folded[1][i]) + lcc_size(out.folded[2][i]));
    const auto alpha_bits = static_cast<uint8_t>(1 + lcc_size(out.folded[3][i]));
    out.estimate[i] = static_cast<uint8_t>(luma_bits + color * color_bits + alpha * alpha_bits);
  }
  uint32_t estimates = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i)
    estimates += out.token[i] == lcc_number(LccToken::kPalette) ? out.estimate[i] : 0u;
  out.estimates = estimates;
}

/// The plain definition of LccKernels::find_planes.
[[gnu::always_inline]] inline void find_planes(const LccPlane<uint32_t>& pixels, LccPlanes& out) {
  std::array<LccPlane<int16_t>, 4> channels;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const LccChannels own = lcc_channels(pixels[i]);
    for (uint32_t c = 0; c < 4; ++c) channels[c][i] = own[c];
  }
  LccPlane<int16_t> gradients{};
  find_residuals<0>(channels[0], gradients, out);
  find_residuals<1>(channels[1], gradients, out);
  find_residuals<2>(channels[2], gradients, out);
  find_residuals<3>(channels[3], gradients, out);
  find_tokens(pixels, gradients, out);
  find_residual_tokens(out);
}

}  // namespace lcc
}  // namespace tilepress
