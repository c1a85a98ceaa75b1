// Surface patterns: frames that codecs find easy, hard or awkward, and their layout in memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "reference_model.h"
#include "tilepress/surface.h"

namespace patterns {

using reference::Picture;
using tilepress::PixelFormat;

/// Small deterministic generator: the same pictures on every machine.
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 1) {}
  uint32_t next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>((state_ ^ state_ >> 18) >> 29);
  }
  uint32_t below(uint32_t limit) { return next() % limit; }

 private:
  uint64_t state_;
};

enum Pattern : uint32_t {
  kSolid,
  kTwoColors,   ///< at random, one in eight
  kGradient,    ///< every channel a ramp
  kNoise,       ///< all bits random
  kRotation65,  ///< 65 colours in turn: one more than a default FVC holds
  kAlphaOnly,   ///< one colour, alpha at random
  kLongRuns,    ///< runs across row ends
  kSkewed,      ///< 200 colours, the frequent ones far more so
  kRectangles,  ///< like a user interface
  kPatternCount
};

inline uint32_t fit(uint32_t word, PixelFormat format) {
  if (format == PixelFormat::kRgb565) return word & 0xFFFF;
  return format == PixelFormat::kRgbx8 ? word | 0xFF000000 : word;
}

inline void fill_rectangle(Picture& picture, uint32_t color, Dice& dice) {
  const uint32_t x0 = dice.below(picture.width), y0 = dice.below(picture.height);
  const uint32_t x1 = x0 + 1 + dice.below(picture.width - x0), y1 = y0 + 1 + dice.below(picture.height - y0);
  for (uint32_t y = y0; y < y1; ++y)
    for (uint32_t x = x0; x < x1; ++x) picture.words[size_t{y} * picture.width + x] = color;
}

inline Picture draw(uint32_t pattern, uint32_t width, uint32_t height, PixelFormat format, uint64_t seed) {
  Dice dice(seed);
  Picture picture{width, height, std::vector<uint32_t>(size_t{width} * height)};
  const uint32_t a = dice.next(), b = dice.next(), step = 1 + dice.below(5);
  uint32_t run_color = a, run_left = 0;
  for (size_t i = 0; i < picture.words.size(); ++i) {
    const auto x = static_cast<uint32_t>(i % width), y = static_cast<uint32_t>(i / width);
    uint32_t& word = picture.words[i];
    switch (pattern) {
      case kTwoColors:
        word = dice.below(8) == 0 ? b : a;
        break;
      case kGradient:
        word = (x * step & 255) | (y * step & 255) << 8 | ((x + y) & 255) << 16 | 0xFF000000;
        break;
      case kNoise:
        word = dice.next();
        break;
      case kRotation65:
        word = a + static_cast<uint32_t>(i + seed) % 65 * 0x01030507;
        break;
      case kAlphaOnly:
        word = (a & 0xFFFFFF) | dice.next() << 24;
        break;
      case kLongRuns:
        if (run_left-- == 0) run_left = dice.below(200), run_color = a + dice.below(90) * 0x010203;
        word = run_color;
        break;
      case kSkewed:
        word = (seed % 7 + dice.below(1 + dice.below(1 + dice.below(200)))) * 0x9E3779B1;
        break;
      default:
        word = a;
    }
  }
  if (pattern == kRectangles)
    for (uint32_t i = 0; i < 24; ++i) fill_rectangle(picture, dice.next(), dice);
  for (uint32_t& word : picture.words) word = fit(word, format);
  return picture;
}

/// The next frame: the same, partly overdrawn, moved, or something else.
inline Picture follow(const Picture& before, PixelFormat format, Dice& dice) {
  Picture picture = before;
  switch (dice.below(4)) {
    case 0:
      return draw(dice.below(kPatternCount), before.width, before.height, format, dice.next());
    case 1:
      for (uint32_t i = 0; i < 3; ++i) fill_rectangle(picture, fit(dice.next(), format), dice);
      return picture;
    case 2:
      for (size_t i = 1; i < picture.words.size(); ++i) picture.words[i] = before.words[i - 1];
      return picture;
    default:
      return picture;
  }
}

/// A picture as a program has it in memory.
class MemorySurface {
 public:
  MemorySurface(const Picture& picture, PixelFormat format, tilepress::ByteOrder order, bool bottom_up,
                uint32_t row_padding) {
    const uint32_t pixel_bytes = format == PixelFormat::kRgb565 ? 2 : 4;
    const size_t pitch = size_t{picture.width} * pixel_bytes + row_padding;
    bytes_.assign(pitch * picture.height, std::byte{0xA5});
    for (uint32_t y = 0; y < picture.height; ++y)
      for (uint32_t x = 0; x < picture.width; ++x) {
        uint32_t word = picture.at(x, y);
        if (order == tilepress::ByteOrder::kBgra)
          word = (word & 0xFF00FF00) | (word & 0xFF) << 16 | (word >> 16 & 0xFF);
        if (format == PixelFormat::kRgbx8)
          word = (word & 0xFFFFFF) | x << 24;  // what lies there must not matter
        const size_t row = bottom_up ? picture.height - 1 - y : y;
        for (uint32_t byte = 0; byte < pixel_bytes; ++byte)
          bytes_[row * pitch + x * pixel_bytes + byte] = static_cast<std::byte>(word >> 8 * byte);
      }
    view_.top_row = bytes_.data() + (bottom_up ? pitch * (picture.height - 1) : 0);
    view_.pitch_bytes = bottom_up ? -static_cast<ptrdiff_t>(pitch) : static_cast<ptrdiff_t>(pitch);
    view_.width = picture.width;
    view_.height = picture.height;
    view_.format = format;
    view_.order = order;
  }
  const tilepress::SurfaceView& view() const { return view_; }

 private:
  std::vector<std::byte> bytes_;
  tilepress::SurfaceView view_;
};

/// Rows on top first, tight, RGBA.
inline MemorySurface in_memory(const Picture& picture, PixelFormat format = PixelFormat::kRgba8) {
  return MemorySurface(picture, format, tilepress::ByteOrder::kRgba, false, 0);
}

}  // namespace patterns
