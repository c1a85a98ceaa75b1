// Tests of the frame cache file: what is written comes back, and nothing else is taken for it.
#include "study/cache/frame_cache.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <thread>

#include "made_frames.h"
#include "study/cache/cache_format.h"

namespace tilepress {
namespace {

using testing::HasSubstr;

FrameCacheReader opened(const std::string& path) {
  FrameCacheReader reader;
  const auto done = reader.open(path);
  EXPECT_TRUE(done) << done.error().text;
  return reader;
}

void expect_frame(FrameCacheReader& reader, uint64_t index, const MadeFrame& frame) {
  ASSERT_LT(index, reader.frame_count());
  EXPECT_EQ(reader.header(index), frame.header);
  std::vector<std::byte> pixels;
  const auto read = reader.read(index, pixels);
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_TRUE(pixels == frame.pixels) << "frame " << index;
  const auto view = reader.view(index);
  ASSERT_TRUE(view) << view.error().text;
  EXPECT_EQ(view->width, frame.header.width);
  EXPECT_EQ(view->height, frame.header.height);
  EXPECT_EQ(view->format, frame.header.format);
  EXPECT_EQ(std::memcmp(view->row(frame.header.height - 1),
                        &frame.pixels[frame.header.pitch_bytes() * (frame.header.height - 1)],
                        frame.header.pitch_bytes()),
            0);
}

class EveryContent : public testing::TestWithParam<std::tuple<Content, PixelFormat>> {};

TEST_P(EveryContent, ComesBackInOrderAndInAnyOrder) {
  const auto [content, format] = GetParam();
  const TestFolder folder;
  // 70 frames have key frames 0, 32 and 64. No row is a whole number of units.
  const auto frames = make_frames(content, 3, 70, 37, 21, format);
  write_cache(folder.file("a.frames"), frames);
  FrameCacheReader reader = opened(folder.file("a.frames"));
  ASSERT_EQ(reader.frame_count(), 70u);
  EXPECT_EQ(reader.raw_bytes(), 70 * frames[0].pixels.size());
  for (uint64_t i = 0; i < 70; ++i) expect_frame(reader, i, frames[i]);
  for (const uint64_t i : {69, 0, 31, 32, 33, 33, 63, 5, 64, 1}) expect_frame(reader, i, frames[i]);
}

INSTANTIATE_TEST_SUITE_P(
    FrameCache, EveryContent,
    testing::Combine(testing::Values(Content::kNoise, Content::kGradient, Content::kMoving, Content::kStill),
                     testing::Values(PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565,
                                     PixelFormat::kRgb10a2, PixelFormat::kRgba16f)));

TEST(FrameCache, GradientsAreCodedWithLz4AndOthersWithZstd) {
  for (const auto& [content, coding] : {std::pair(Content::kGradient, FrameCoding::kLz4Up),
                                        std::pair(Content::kMoving, FrameCoding::kZstd)}) {
    const TestFolder folder;
    write_cache(folder.file("a.frames"), make_frames(content, 0, 2, 256, 256));
    const int fd = open(folder.file("a.frames").c_str(), O_RDONLY);
    const auto index = read_cache_index(fd);
    close(fd);
    ASSERT_TRUE(index);
    EXPECT_EQ(index->entries[0].coding, coding);
    EXPECT_EQ(index->entries[1].coding, coding);
    EXPECT_TRUE(index->entries[0].key);
    EXPECT_FALSE(index->entries[1].key);
  }
}

TEST(FrameCache, WhatEqualsTheFrameBeforeIsLeftOut) {
  const TestFolder folder;
  write_cache(folder.file("one.frames"), make_frames(Content::kNoise, 0, 1, 256, 256));
  auto frames = make_frames(Content::kNoise, 0, 2, 256, 256);
  frames[1].pixels = frames[0].pixels;
  write_cache(folder.file("two.frames"), frames);
  // The second frame is a map of 512 zero bytes and 80 bytes of index.
  EXPECT_LT(std::filesystem::file_size(folder.file("two.frames")),
            std::filesystem::file_size(folder.file("one.frames")) + 200);
}

TEST(FrameCache, SurfacesInterleave) {
  const TestFolder folder;
  const auto first = make_frames(Content::kMoving, 0, 40, 64, 32);
  const auto second = make_frames(Content::kGradient, 7, 40, 33, 9, PixelFormat::kRgb565);
  std::vector<MadeFrame> frames;
  for (size_t i = 0; i < 40; ++i) {
    frames.push_back(first[i]);
    if (i % 3 == 0) frames.push_back(second[i]);
  }
  write_cache(folder.file("a.frames"), frames);
  FrameCacheReader reader = opened(folder.file("a.frames"));
  ASSERT_EQ(reader.frame_count(), frames.size());
  for (uint64_t i = 0; i < frames.size(); ++i) expect_frame(reader, i, frames[i]);
  for (uint64_t i = frames.size(); i-- > 0;) expect_frame(reader, i, frames[i]);
}

TEST(FrameCache, ReadersOfOneFileWorkOnThreads) {
  const TestFolder folder;
  const auto frames = make_frames(Content::kMoving, 0, 40, 64, 64);
  write_cache(folder.file("a.frames"), frames);
  const FrameCacheReader reader = opened(folder.file("a.frames"));
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      FrameCacheReader own = reader.another();
      for (size_t i = 0; i < frames.size(); ++i)
        expect_frame(own, (i * 7 + t) % 40, frames[(i * 7 + t) % 40]);
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(FrameCache, OriginComesBack) {
  const TestFolder folder;
  CacheOrigin origin;
  origin.key = std::string(64, 'a');
  origin.input = "/traces/\"odd\" name\n.trace";
  origin.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  origin.reason = "truncated";
  origin.expected_frames = 12;
  origin.unsupported_frames = 3;
  write_cache(folder.file("a.frames"), make_frames(Content::kStill, 0, 1, 8, 8), origin);
  const FrameCacheReader reader = opened(folder.file("a.frames"));
  EXPECT_EQ(reader.origin().key, origin.key);
  EXPECT_EQ(reader.origin().input, origin.input);
  EXPECT_EQ(reader.origin().gl_renderer, origin.gl_renderer);
  EXPECT_EQ(reader.origin().reason, origin.reason);
  EXPECT_EQ(reader.origin().expected_frames, 12u);
  EXPECT_EQ(reader.origin().unsupported_frames, 3u);
}

TEST(FrameCache, DigestIsThatOfFramesAndNotOfTimes) {
  const TestFolder folder;
  const auto digest_of = [&](const std::vector<MadeFrame>& frames, const char* input) {
    CacheOrigin origin;
    origin.input = input;
    write_cache(folder.file("a.frames"), frames, origin);
    return opened(folder.file("a.frames")).frames_digest();
  };
  auto frames = make_frames(Content::kMoving, 0, 5, 32, 32);
  const std::string digest = digest_of(frames, "one");
  EXPECT_EQ(digest.size(), 64u);
  frames[2].header.time_ns += 5;
  frames[3].header.readback_ns += 5;
  EXPECT_EQ(digest_of(frames, "two"), digest);
  frames[4].pixels[77] ^= std::byte{1};
  EXPECT_NE(digest_of(frames, "one"), digest);
  frames[4].pixels[77] ^= std::byte{1};
  frames[4].header.warmup = true;
  EXPECT_NE(digest_of(frames, "one"), digest);
}

TEST(FrameCache, NoFramesAreAWholeFile) {
  const TestFolder folder;
  write_cache(folder.file("a.frames"), {});
  EXPECT_EQ(opened(folder.file("a.frames")).frame_count(), 0u);
}

TEST(FrameCacheWriter, LeavesNothingWithoutFinish) {
  const TestFolder folder;
  {
    FrameCacheWriter writer;
    ASSERT_TRUE(writer.create(folder.file("a.frames")));
    const auto frames = make_frames(Content::kStill, 0, 1, 8, 8);
    ASSERT_TRUE(writer.add(frames[0].header, frames[0].pixels));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.frames")));
    EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FrameCacheWriter, RefusesFramesThatDoNotFollow) {
  const TestFolder folder;
  FrameCacheWriter writer;
  ASSERT_TRUE(writer.create(folder.file("a.frames")));
  auto frames = make_frames(Content::kStill, 0, 3, 8, 8);
  ASSERT_TRUE(writer.add(frames[1].header, frames[1].pixels));
  const auto earlier = writer.add(frames[0].header, frames[0].pixels);
  ASSERT_FALSE(earlier);
  EXPECT_EQ(earlier.error().text,
            folder.file("a.frames") + ": frame 0 of surface 0 comes after a later frame");
  const auto wider = make_frames(Content::kStill, 0, 3, 16, 8);
  const auto other_size = writer.add(wider[2].header, wider[2].pixels);
  ASSERT_FALSE(other_size);
  EXPECT_THAT(other_size.error().text, HasSubstr("another size or format"));
  frames[2].pixels.pop_back();
  EXPECT_FALSE(writer.add(frames[2].header, frames[2].pixels));
}

TEST(FrameCacheWriter, NamesAFullDisk) {
  // Every write to /dev/full fails with ENOSPC. A link makes it the file of the writer.
  const TestFolder folder;
  FrameCacheWriter probe;
  ASSERT_TRUE(probe.create(folder.file("a.frames")));
  std::string work;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) work = entry.path();
  FrameCacheWriter writer;
  std::filesystem::remove(work);
  std::filesystem::create_symlink("/dev/full", work);
  const auto created = writer.create(folder.file("a.frames"));
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().text, folder.file("a.frames") + ": No space left on device");
}

}  // namespace
}  // namespace tilepress
