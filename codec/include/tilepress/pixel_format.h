// Pixel formats: the meaning of a pixel's bits.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tilepress {

/// Native format of a surface. A pixel word holds the pixel's memory bytes, little-endian, in its low bits.
///   rgba8    R | G<<8 | B<<16 | A<<24
///   rgbx8    the same with A = 255 always: a surface without alpha
///   rgb565   B | G<<5 | R<<11 (GL_UNSIGNED_SHORT_5_6_5)
///   rgb10a2  R | G<<10 | B<<20 | A<<30 (GL_UNSIGNED_INT_2_10_10_10_REV)
///   rgba16f  half floats; reported by name, not modelled
enum class PixelFormat : uint8_t { kRgba8, kRgbx8, kRgb565, kRgb10a2, kRgba16f };

struct FormatTraits {
  std::string_view name;                 ///< as written to the statistics
  uint32_t pixel_bits;                   ///< bits a pixel occupies in memory
  std::array<uint8_t, 4> channel_bits;   ///< R, G, B, A; 0 = channel absent
  std::array<uint8_t, 4> channel_shift;  ///< position of the channel's lowest bit in the word
  bool modelled;                         ///< false: frames are counted and reported, but never compressed
};

constexpr FormatTraits kFormatTraits[] = {
    {"RGBA8", 32, {8, 8, 8, 8}, {0, 8, 16, 24}, true},
    {"RGBX8", 32, {8, 8, 8, 8}, {0, 8, 16, 24}, true},
    {"RGB565", 16, {5, 6, 5, 0}, {11, 5, 0, 0}, true},
    {"RGB10A2", 32, {10, 10, 10, 2}, {0, 10, 20, 30}, true},
    {"RGBA16F", 64, {16, 16, 16, 16}, {0, 16, 32, 48}, false},
};

constexpr const FormatTraits& traits(PixelFormat format) {
  return kFormatTraits[static_cast<size_t>(format)];
}

/// Returns channel `c` (0..3 = R,G,B,A) of a pixel word; 0 for an absent channel.
constexpr uint32_t channel(const FormatTraits& t, uint32_t word, int c) {
  return (word >> t.channel_shift[c]) & ((1u << t.channel_bits[c]) - 1u);
}

}  // namespace tilepress
