// Bounds: sizes are those of the libraries themselves.
#include <gtest/gtest.h>
#include <lz4.h>
#include <zstd.h>

#include <array>
#include <cstring>

#include "study/bounds/bound_coders.h"
#include "study/bounds/model_bounds.h"

namespace tilepress {
namespace {

constexpr size_t kZstdHeaderBytes = 7;  // magic number 4, descriptor 1, content size 2

/// Two blocks side by side: a gradient with a few colours, and noise. Part of the noise is outside the surface.
struct SmallFrame {
  static constexpr uint32_t kWidth = 14, kHeight = 8;
  std::array<uint32_t, kWidth * kHeight> pixels{};
  SmallFrame() {
    for (uint32_t i = 0; i < pixels.size(); ++i)
      pixels[i] = 0xFF000000 | (i % kWidth < 8 ? i % kWidth / 2 * 0x101010 : i * 2654435761u >> 8);
  }
  SurfaceView view(PixelFormat format = PixelFormat::kRgba8) const {
    return {.top_row = reinterpret_cast<const std::byte*>(pixels.data()),
            .pitch_bytes = kWidth * 4,
            .width = kWidth,
            .height = kHeight,
            .format = format};
  }
};

std::vector<SchemeStatistics> measured(const SurfaceView& view, uint32_t burst_bits) {
  PixelPlane plane;
  plane.assign(view);
  std::vector<SchemeStatistics> out;
  EXPECT_TRUE(BoundCoders().measure(plane, burst_bits, out));
  return out;
}

size_t lz4_bytes(const std::string& bytes) {
  std::string coded(static_cast<size_t>(LZ4_compressBound(static_cast<int>(bytes.size()))), '\0');
  return static_cast<size_t>(LZ4_compress_default(bytes.data(), coded.data(), static_cast<int>(bytes.size()),
                                                  static_cast<int>(coded.size())));
}

std::string zstd_frame(const std::string& bytes) {
  std::string coded(ZSTD_compressBound(bytes.size()), '\0');
  coded.resize(ZSTD_compress(coded.data(), coded.size(), bytes.data(), bytes.size(), 3));
  return coded;
}

/// A block's bytes in traversal order: 2×2 sub-blocks in raster order. Columns outside the surface repeat the last.
std::string block_bytes(const SmallFrame& frame, uint32_t left) {
  std::string out;
  for (uint32_t y = 0; y < 8; y += 2)
    for (uint32_t x = 0; x < 8; x += 2)
      for (const auto& [dx, dy] : {std::pair{0u, 0u}, {1u, 0u}, {0u, 1u}, {1u, 1u}}) {
        const uint32_t column = std::min(left + x + dx, SmallFrame::kWidth - 1);
        const uint32_t word = frame.pixels[(y + dy) * SmallFrame::kWidth + column];
        for (uint32_t shift = 0; shift < 32; shift += 8) out += static_cast<char>(word >> shift & 0xFF);
      }
  return out;
}

TEST(Bounds, OfBlocksAreTheLibrariesSizesInBursts) {
  const SmallFrame frame;
  const std::string left = block_bytes(frame, 0), right = block_bytes(frame, 8);
  for (const uint32_t burst : {128u, 256u}) {
    const auto bounds = measured(frame.view(), burst);
    const auto expect = [&](const SchemeStatistics& bound, std::initializer_list<size_t> sizes) {
      uint64_t bits = 0, bursts = 0;
      for (const size_t size : sizes) {
        const uint64_t block = std::min<uint64_t>(size * 8, 2048);
        bits += block;
        bursts += (block + burst - 1) / burst;
      }
      EXPECT_EQ(bound.payload_bits, bits);
      EXPECT_EQ(bound.bursts, bursts);
      EXPECT_EQ(bound.blocks, 2u);
      EXPECT_EQ(bound.raw_bits, 4096u);
      EXPECT_EQ(bound.moved_bits(), bursts * burst);
    };
    expect(bounds[0], {lz4_bytes(left), lz4_bytes(right)});
    const std::string coded_left = zstd_frame(left), coded_right = zstd_frame(right);
    EXPECT_EQ(coded_left.substr(0, kZstdHeaderBytes), coded_right.substr(0, kZstdHeaderBytes));
    expect(bounds[1], {coded_left.size() - kZstdHeaderBytes, coded_right.size() - kZstdHeaderBytes});
    // Noise does not get smaller: it is stored raw.
    EXPECT_GT(lz4_bytes(right), 256u * 3 / 4);
    EXPECT_LT(lz4_bytes(left), 128u);
  }
}

TEST(Bounds, OfWholeFramesAreTheLibrariesSizesOfItsRows) {
  const SmallFrame frame;
  const std::string rows(reinterpret_cast<const char*>(frame.pixels.data()), sizeof frame.pixels);
  const auto bounds = measured(frame.view(), 128);
  EXPECT_EQ(bounds[2].payload_bits, lz4_bytes(rows) * 8);
  EXPECT_EQ(bounds[3].payload_bits, zstd_frame(rows).size() * 8);
  EXPECT_EQ(bounds[3].bursts, (zstd_frame(rows).size() + 15) / 16);
  EXPECT_GT(bounds[4].payload_bits, 0u);
  EXPECT_LT(bounds[4].payload_bits, bounds[4].raw_bits);
}

TEST(Bounds, OfWebpKeepTheColoursOfTransparentPixels) {
  SmallFrame frame;
  for (uint32_t i = 0; i < frame.pixels.size(); ++i) frame.pixels[i] = i * 2654435761u >> 8;  // alpha 0
  // 112 pixels with 24 random bits.
  EXPECT_GT(measured(frame.view(), 128)[4].payload_bits, 112u * 24 * 3 / 4);
}

/// One frame of each of two surfaces, and a second frame of the first.
FrameFeed two_formats() {
  return [frame = SmallFrame(), next = uint64_t{0}](FedFrame& out) mutable -> Result<bool> {
    if (next == 3) return false;
    const bool second = next == 1;
    out = {.frame = next / 2,
           .surface = second,
           .view = frame.view(second ? PixelFormat::kRgb565 : PixelFormat::kRgba8)};
    ++next;
    return true;
  };
}

TEST(Bounds, LeaveOutSurfacesWithoutEightBitChannels) {
  const std::atomic<int> stop = 0;
  std::atomic<uint64_t> done = 0;
  const auto rows = model_bounds(two_formats(), RunOptions(), stop, done);
  ASSERT_TRUE(rows && *rows);
  EXPECT_EQ(done, 3u);
  EXPECT_EQ((*rows)->skipped, std::vector<std::string>{"surface 1: the bounds do not support RGB565"});
  ASSERT_EQ((*rows)->schemes.size(), bound_names().size());
  for (const std::string& text : (*rows)->schemes) {
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;  // header, warm-up, frame 1
    EXPECT_NE(text.find("\n1,0,"), std::string::npos);
    EXPECT_EQ(text.find(",1,lz4"), std::string::npos);
  }
}

}  // namespace
}  // namespace tilepress
