// Made frames: contents computed from frame number and position.
#include "made_frames.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace tilepress {
namespace {

constexpr uint32_t kSquareSide = 8;

std::byte gradient(uint32_t frame, size_t x, size_t y) {
  // One step from row to row. Along a row the bytes look random.
  return static_cast<std::byte>((static_cast<uint32_t>(x) * 2654435761u >> 24) + y + frame * 3);
}

std::byte moving(uint32_t frame, size_t x, size_t y, size_t pitch) {
  const size_t left = frame * 4 % pitch;
  const bool inside = x >= left && x < left + kSquareSide * 4 && y >= frame && y < frame + kSquareSide;
  return static_cast<std::byte>(inside ? 255 : (x * 7 + y * 13) % 251);
}

}  // namespace

TestFolder::TestFolder() {
  const char* base = std::getenv("TMPDIR");
  path_ = std::string(base != nullptr ? base : "/tmp") + "/frame-cache-test-XXXXXX";
  if (mkdtemp(path_.data()) == nullptr) ADD_FAILURE() << path_;
}

TestFolder::~TestFolder() {
  std::error_code code;
  std::filesystem::remove_all(path_, code);
}

std::vector<MadeFrame> make_frames(Content content, uint32_t surface, uint32_t count, uint32_t width,
                                   uint32_t height, PixelFormat format) {
  std::vector<MadeFrame> frames;
  std::minstd_rand random(surface + 1);
  for (uint32_t number = 0; number < count; ++number) {
    MadeFrame frame;
    frame.header.frame = number;
    frame.header.surface = surface;
    frame.header.width = width;
    frame.header.height = height;
    frame.header.format = format;
    frame.header.warmup = number == 0;
    frame.header.time_ns = number * 1000 + surface;
    frame.header.readback_ns = number + 7;
    const size_t pitch = frame.header.pitch_bytes();
    frame.pixels.resize(frame.header.pixel_bytes());
    for (size_t i = 0; i < frame.pixels.size(); ++i) {
      const size_t x = i % pitch, y = i / pitch;
      frame.pixels[i] = content == Content::kNoise      ? static_cast<std::byte>(random() >> 8)
                        : content == Content::kGradient ? gradient(number, x, y)
                        : content == Content::kMoving   ? moving(number, x, y, pitch)
                                                        : moving(0, x, y, pitch);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

void write_cache(const std::string& path, const std::vector<MadeFrame>& frames, const CacheOrigin& origin) {
  FrameCacheWriter writer;
  const auto created = writer.create(path);
  ASSERT_TRUE(created) << created.error().text;
  for (const MadeFrame& frame : frames) {
    const auto added = writer.add(frame.header, frame.pixels);
    ASSERT_TRUE(added) << added.error().text;
  }
  const auto finished = writer.finish(origin);
  ASSERT_TRUE(finished) << finished.error().text;
}

std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace tilepress
