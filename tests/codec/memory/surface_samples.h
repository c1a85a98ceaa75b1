// Surface samples: synthetic frames for tests of compressed surfaces, always the same.
#pragma once

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"
#include "tilepress/surface.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Pixel words of a frame; `words[y * width + x]`.
struct SampleFrame {
  uint32_t width, height;
  PixelFormat format;
  std::vector<uint32_t> words;
  std::vector<std::byte> bytes;  ///< the same as the surface's memory

  void pack() {
    const size_t pixel_bytes = traits(format).pixel_bits / 8;
    bytes.resize(words.size() * pixel_bytes);
    for (size_t i = 0; i < words.size(); ++i) std::memcpy(&bytes[i * pixel_bytes], &words[i], pixel_bytes);
  }
  SurfaceView view() const {
    return {bytes.data(), static_cast<ptrdiff_t>(width * (traits(format).pixel_bits / 8)),
            width,        height,
            format,       ByteOrder::kNative};
  }
};

/// A third solid, a third of few colours, a third noise: all kinds of blocks beside each other. Frames of
/// different seeds share their frequent colours.
inline SampleFrame mixed_frame(uint32_t width, uint32_t height, PixelFormat format, uint32_t seed) {
  SampleFrame frame{width, height, format, std::vector<uint32_t>(size_t{width} * height), {}};
  std::mt19937 random(seed);
  const uint32_t mask = traits(format).pixel_bits == 16 ? 0xFFFFu : 0xFFFFFFFFu;
  const uint32_t fixed = format == PixelFormat::kRgbx8 ? 0xFF000000u : 0;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      uint32_t word = 0x11223344u;
      const uint32_t kind = (x / 11 + y / 13) % 4;
      if (kind == 1) word = 0x01010101u * (random() % 5);
      if (kind == 2) word = static_cast<uint32_t>(random());
      if (kind == 3) word = 0x10203040u + x + 0x100u * y;
      frame.words[size_t{y} * width + x] = (word & mask) | fixed;
    }
  frame.pack();
  return frame;
}

/// Runs `frames` through the scheme; the last one's surface. Empty scheme text = a scheme that does not
/// parse.
inline CompressedSurface compress(const std::string& scheme, const std::vector<SampleFrame>& frames,
                                  const ModelOptions& options, SchemeStatistics* statistics = nullptr) {
  SurfaceEngine engine({*parse_scheme(scheme)}, options);
  CompressedSurface surface;
  FrameStatistics out;
  for (const SampleFrame& frame : frames) engine.process(frame.view(), out, std::span(&surface, 1));
  if (statistics != nullptr) *statistics = out.schemes.front();
  return surface;
}

}  // namespace tilepress
