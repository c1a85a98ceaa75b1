// Live samples: frames whose every pixel and count follows from a number, so that a mixture of two is seen.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"

namespace tilepress {

/// An empty folder that goes with the test.
class LiveFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/tilepress-live-XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
    info_.program = "gears";
    info_.pid = 4711;
    options_.schemes.resize(2);
    options_.schemes[0].text = "dcp";
    options_.schemes[1].text = "ras";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  bool has(const char* file) const { return std::filesystem::exists(folder_ + "/" + file); }

  std::string folder_;
  RunInfo info_;
  RunOptions options_;
};

inline void update_page(LiveWriter& writer, uint64_t n) {
  FrameStatistics frame;
  frame.frame = n;
  frame.width = 640;
  frame.height = 480;
  SchemeStatistics sizes;
  sizes.raw_bits = 512 * n;
  sizes.bursts = n;
  frame.schemes = {sizes, sizes};
  RunCounts counts;
  counts.seen = counts.captured = n;
  writer.update(frame, frame.schemes, counts, 1, 3);
}

/// Picture `n`: pixel (x, y) is n << 16 | y << 8 | x, and every block takes n bits in the first scheme and
/// n + 1 in the second.
struct SamplePicture {
  std::vector<uint32_t> pixels;
  SurfaceView view;
  BlockBits bits;
  SamplePicture(uint32_t n, uint32_t width, uint32_t height) : pixels(size_t{width} * height) {
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) pixels[size_t{y} * width + x] = n << 16 | y << 8 | x;
    view.top_row = reinterpret_cast<const std::byte*>(pixels.data());
    view.pitch_bytes = static_cast<ptrdiff_t>(width) * 4;
    view.width = width;
    view.height = height;
    bits.blocks_x = (width + 7) / 8;
    bits.blocks_y = (height + 7) / 8;
    bits.raw_bits = 2048;
    const size_t blocks = size_t{bits.blocks_x} * bits.blocks_y;
    bits.schemes = {std::vector<uint16_t>(blocks, static_cast<uint16_t>(n)),
                    std::vector<uint16_t>(blocks, static_cast<uint16_t>(n + 1))};
  }
};

inline LiveState sample_state(uint64_t n) {
  LiveState state{};
  state.frame = n;
  state.scheme_count = 2;
  return state;
}

/// Whether `picture` is picture `n` and nothing else.
inline bool is_sample(const LivePicture& picture, uint32_t n) {
  const LivePictureHead& head = picture.head;
  if (head.state.frame != n || picture.bits.size() != 2) return false;
  for (uint32_t y = 0; y < head.height; ++y)
    for (uint32_t x = 0; x < head.width; ++x)
      if (picture.pixels[y * head.blocks_x * 8 + x] != (n << 16 | y << 8 | x)) return false;
  const size_t blocks = head.blocks_x * head.blocks_y;
  return picture.bits[0] == std::vector<uint16_t>(blocks, static_cast<uint16_t>(n)) &&
         picture.bits[1] == std::vector<uint16_t>(blocks, static_cast<uint16_t>(n + 1));
}

}  // namespace tilepress
