// Symbols of LCC: what is coded for each pixel of a block, and in which context. Encoder, decoder and tables
// share these rules.
//
// Pixels follow in raster order. A pixel's neighbours are left, above, above left and above right. In row 0
// all four are the left pixel. In column 0 left and above left are the pixel above, in column 7 above right
// is the pixel above.
//
// A pixel is a *token*, the first that fits: equal to a neighbour (left, above, above left, above right), a
// colour of the CCD, or a *residual*: the difference to what the median edge rule predicts, for luma alone,
// for luma and both colours, or for these and alpha. Luma is G; the colours are R − G and B − G, wrapped to
// −128 … 127. Predictions and gradients are plain integers. A residual is wrapped to −128 … 127.
//
// A colour of the CCD is taken if the residuals would take over 2 bits more than its index by a fixed
// estimate: 1 + bit width of u for each channel of the token (u below). So tokens do not depend on the code
// tables.
//
// The *context* of a token is the shape of the neighbourhood, and how many of left and above are residuals.
// The first pixel is none. In row 0 and column 0, where left and above are the same pixel, a residual counts
// twice. The first shape that fits:
//
//   0, 1   left = above = above left: 0 if above right equals them too, else 1
//   2      left = above left
//   3      above = above left
//   4      left = above
//   5 … 7  others, by the gradients of luma, R − G and B − G added up: 0 to 8, 9 to 32, more
//
// A *gradient* of a channel is |left − above left| + |above − above left|. Its class is 0 to 7. The context
// of a residual is
//
//   luma           the class of the gradient; luma alone has contexts of its own
//   R − G, B − G   half the class, rounded up, and the bit width, at most 7, of the residual u before: that
//                  of luma for R − G, that of R − G for B − G. Each of the two has contexts of its own
//   alpha          the class of the gradient
//
// A residual e is folded to u = 2e (e ≥ 0), −2e − 1 (e < 0). Its *class* is u itself up to 4. Above, each
// octave of u − 1 has two classes, and the lower bits follow plainly:
//
//   class      0  1  2  3  4  5     6     7     8      9      10     11     12  …  16
//   u − 1            …        4-5   6-7   8-11  12-15  16-23  24-31  32-47  48-63 … 192-254
//   bits after 0  0  0  0  0  1     1     2     2      3      3      4      4   …  6
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

enum class LccToken : uint8_t {
  kLeft,
  kAbove,
  kAboveLeft,
  kAboveRight,
  kPalette,
  kLuma,   ///< a residual of luma; the other channels are as predicted
  kColor,  ///< residuals of luma and both colours
  kAlpha,  ///< residuals of all four channels
};
constexpr uint32_t lcc_number(LccToken token) {
  return static_cast<uint32_t>(token);
}
constexpr uint32_t kLccTokens = 8;
constexpr uint32_t kLccClasses = 17;  ///< of residuals
constexpr uint32_t kLccTokenContexts = 24;
constexpr uint32_t kLccResidualContexts = 104;
constexpr uint32_t kLccContexts = kLccTokenContexts + kLccResidualContexts;
/// Symbols of all contexts, numbered in one row: tokens context by context, then classes.
constexpr uint32_t kLccFirstClass = kLccTokenContexts * kLccTokens;
constexpr uint32_t kLccSymbols = kLccFirstClass + kLccResidualContexts * kLccClasses;
/// The estimate for residuals must exceed the bits of an index by more than this for a colour of the CCD.
constexpr uint32_t kLccPaletteMargin = 2;
/// Blocks whose estimates sum up to this or more are noise, mostly stored raw: nothing is learned from them.
/// Pixels that equal a neighbour, and the first, add nothing. Colours of the CCD add what their residuals
/// would.
constexpr uint32_t kLccNoise = 1984;

/// Raster positions of the neighbours of each pixel. Those of pixel 0 have no meaning.
struct LccNeighbors {
  std::array<uint8_t, kBlockPixels> left{}, above{}, above_left{}, above_right{};
};
constexpr LccNeighbors make_lcc_neighbors() {
  LccNeighbors all;
  for (uint32_t i = 1; i < kBlockPixels; ++i) {
    const uint32_t x = i % kBlockSide, y = i / kBlockSide;
    const uint32_t above = y == 0 ? i - 1 : i - 8;
    all.above[i] = static_cast<uint8_t>(above);
    all.left[i] = static_cast<uint8_t>(x == 0 ? above : i - 1);
    all.above_left[i] = static_cast<uint8_t>(x == 0 ? above : y == 0 ? i - 1 : i - 9);
    all.above_right[i] = static_cast<uint8_t>(x == 7 || y == 0 ? above : i - 7);
  }
  return all;
}
constexpr LccNeighbors kLccNeighbors = make_lcc_neighbors();

/// Channels of a pixel: luma and alpha 0 to 255, colours −128 to 127.
using LccChannels = std::array<int16_t, 4>;
constexpr uint32_t kLccAlpha = 3;
constexpr LccChannels lcc_channels(uint32_t pixel) {
  const auto byte = [&](uint32_t at) { return static_cast<int16_t>(pixel >> at & 255); };
  const int16_t green = byte(8);
  return {green, static_cast<int8_t>(byte(0) - green), static_cast<int8_t>(byte(16) - green), byte(24)};
}
constexpr uint32_t lcc_pixel(const LccChannels& channels) {
  const auto byte = [](int value) { return static_cast<uint32_t>(value) & 255; };
  return byte(channels[1] + channels[0]) | byte(channels[0]) << 8 | byte(channels[2] + channels[0]) << 16 |
         byte(channels[3]) << 24;
}

/// Median edge rule.
constexpr int16_t lcc_predict(int16_t left, int16_t above, int16_t above_left) {
  const int16_t low = left < above ? left : above, high = left < above ? above : left;
  const auto plane = static_cast<int16_t>(left + above - above_left);
  const int16_t limited = plane > high ? high : plane;
  return limited < low ? low : limited;
}
/// How much the neighbours of a channel differ.
constexpr int16_t lcc_gradient(int16_t left, int16_t above, int16_t above_left) {
  const auto across = static_cast<int16_t>(left - above_left),
             down = static_cast<int16_t>(above - above_left);
  return static_cast<int16_t>((across < 0 ? -across : across) + (down < 0 ? -down : down));
}
/// How many of the ascending bounds the value reaches.
template <int... kBounds>
constexpr uint8_t count_reached(int value) {
  return static_cast<uint8_t>((static_cast<uint8_t>(value >= kBounds) + ...));
}
/// Classes of gradients: 0, 1, 2, 3-4, 5-8, 9-16, 17-32, more.
constexpr uint8_t lcc_gradient_class(int16_t gradient) {
  return count_reached<1, 2, 3, 5, 9, 17, 33>(gradient);
}

/// Shapes of the neighbourhood: 0 to 4 by which neighbours are equal, 5 to 7 where they differ by how much.
/// `gradients` is the sum over luma and colours.
constexpr uint32_t lcc_shape(uint32_t left, uint32_t above, uint32_t above_left, uint32_t above_right,
                             int gradients) {
  const uint32_t busy = 5 + uint32_t{gradients > 8} + (gradients > 32);
  const bool all_left = (left == above) & (left == above_left);
  const uint32_t flat = above_right == above ? 0 : 1;
  const uint32_t unequal = left == above ? 4 : busy;
  const uint32_t not_beside = above == above_left ? 3 : unequal;
  const uint32_t not_flat = left == above_left ? 2 : not_beside;
  return all_left ? flat : not_flat;
}
/// Number of a token. `residuals` counts left and above if they are residuals.
constexpr uint32_t lcc_token_symbol(uint32_t shape, uint32_t residuals, LccToken token) {
  return (shape * 3 + residuals) * kLccTokens + lcc_number(token);
}
/// Class of a folded residual, and the number of bits after it.
constexpr uint8_t lcc_class(uint8_t folded) {
  return static_cast<uint8_t>(
      count_reached<1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193>(folded));
}
constexpr uint8_t lcc_bits_after(uint8_t number) {
  return static_cast<uint8_t>((number > 3 ? number - 3 : 0) / 2);
}
/// The folded residual of a class and the bits after it; 256 for the one rest that none has.
constexpr uint32_t lcc_folded(uint32_t number, uint32_t rest) {
  if (number < 5) return number;
  return ((2 + (number - 5) % 2) << lcc_bits_after(static_cast<uint8_t>(number))) + rest + 1;
}
/// The bits after the class of a folded residual, for a class of that many.
constexpr uint32_t lcc_rest(uint32_t folded, uint32_t bits) {
  return (folded - 1) & ((1u << bits) - 1);
}
/// Bit width of a folded residual.
constexpr uint8_t lcc_size(uint8_t folded) {
  return count_reached<1, 2, 4, 8, 16, 32, 64, 128>(folded);
}

/// Number of class 0 of a channel's residual. `before` is the folded residual of the channel before. The
/// number is that of kColor and kAlpha: for kLuma, subtract kLccLumaAlone.
constexpr uint16_t lcc_class_symbol(uint32_t channel, uint8_t gradient_class, uint8_t before) {
  const uint32_t context = channel == 0           ? 8u + gradient_class
                           : channel == kLccAlpha ? 16u + gradient_class
                                                  : 24 + (channel - 1) * 40 + (gradient_class + 1u) / 2 * 8 +
                                                        count_reached<1, 2, 4, 8, 16, 32, 64>(before);
  return static_cast<uint16_t>(kLccFirstClass + context * kLccClasses);
}
constexpr uint32_t kLccLumaAlone = 8 * kLccClasses;
/// Channels of a token that is a residual: luma is 0, so a token has the first so many.
constexpr uint32_t lcc_residual_channels(LccToken token) {
  return token == LccToken::kLuma ? 1 : token == LccToken::kColor ? 3 : 4;
}

}  // namespace tilepress
