// Tests of the reader against damaged files: it returns an error or the right pixels, and never reads
// outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "frames/little_endian.h"
#include "made_frames.h"
#include "study/cache/cache_format.h"

namespace tilepress {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

std::vector<MadeFrame> some_frames() {
  auto frames = make_frames(Content::kMoving, 0, 3, 40, 24);
  for (MadeFrame& frame : make_frames(Content::kGradient, 1, 3, 40, 20)) frames.push_back(std::move(frame));
  return frames;
}

/// Opens the bytes as a file and reads all frames. Returns the first error, or nothing if all frames are
/// right.
std::optional<Error> read_all(const TestFolder& folder, const std::string& bytes,
                              const std::vector<MadeFrame>* expected) {
  write_bytes(folder.file("damaged.frames"), bytes);
  FrameCacheReader reader;
  if (const auto opened = reader.open(folder.file("damaged.frames")); !opened) return opened.error();
  for (uint64_t i = 0; i < reader.frame_count(); ++i) {
    std::vector<std::byte> pixels;
    if (const auto read = reader.read(i, pixels); !read) return read.error();
    if (expected == nullptr) continue;
    EXPECT_TRUE(i < expected->size() && pixels == (*expected)[i].pixels) << "frame " << i;
  }
  return std::nullopt;
}

class HostileCache : public testing::Test {
 protected:
  HostileCache() : frames_(some_frames()) {
    write_cache(folder_.file("good.frames"), frames_);
    good_ = bytes_of_file(folder_.file("good.frames"));
  }
  /// Puts new hashes where the index says, so that damage gets past them.
  std::string with_new_hashes(std::string bytes) const {
    const size_t footer = bytes.size() - kCacheFooterBytes;
    const uint64_t offset = Fields(std::string_view(bytes).substr(footer)).take(8);
    const uint64_t count = Fields(std::string_view(bytes).substr(footer + 8)).take(8);
    for (uint64_t i = 0; i < count && offset + (i + 1) * kCacheEntryBytes <= footer; ++i) {
      const size_t entry = offset + i * kCacheEntryBytes;
      const uint64_t at = Fields(std::string_view(bytes).substr(entry + 40)).take(8);
      const uint64_t size = Fields(std::string_view(bytes).substr(entry + 48)).take(8);
      if (at <= bytes.size() && size <= bytes.size() - at)
        put(bytes, entry + 56, hash(bytes.substr(at, size)));
    }
    put(bytes, footer + 24, hash(bytes.substr(offset, footer + 24 - offset)));
    return bytes;
  }
  static void put(std::string& bytes, size_t at, uint64_t value) {
    std::string field;
    put_field(field, value, 8);
    bytes.replace(at, 8, field);
  }
  static uint64_t hash(const std::string& bytes) { return hash_of(std::as_bytes(std::span(bytes))); }

  const TestFolder folder_;
  const std::vector<MadeFrame> frames_;
  std::string good_;
};

TEST_F(HostileCache, GoodBytesAreRight) {
  EXPECT_FALSE(read_all(folder_, good_, &frames_));
  EXPECT_EQ(with_new_hashes(good_), good_);
}

TEST_F(HostileCache, TornAtAnyByteIsAnError) {
  for (size_t size = 0; size < good_.size(); size += 1 + size / 64) {
    const auto error = read_all(folder_, good_.substr(0, size), nullptr);
    ASSERT_TRUE(error) << size;
    EXPECT_THAT(error->text,
                EndsWith(size < kCacheHeaderBytes ? "is no frame cache" : "is torn or no whole frame cache"));
    EXPECT_EQ(error->text.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(read_all(folder_, good_ + "x", nullptr));
}

TEST_F(HostileCache, AnyFlippedBitIsAnError) {
  std::minstd_rand random(1);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = good_;
    const size_t at = random() % bytes.size();
    if (at >= 12 && at < kCacheHeaderBytes) continue;  // reserved
    bytes[at] = static_cast<char>(bytes[at] ^ 1 << (random() % 8));
    ASSERT_TRUE(read_all(folder_, bytes, nullptr)) << "byte " << at;
  }
}

TEST_F(HostileCache, OtherVersionsAndFilesAreNamed) {
  std::string newer = good_;
  newer[8] = 2;
  EXPECT_THAT(read_all(folder_, newer, nullptr)->text,
              EndsWith("is a frame cache of format 2; this version reads format 1"));
  EXPECT_EQ(read_all(folder_, newer, nullptr)->kind, ErrorKind::kUnsupported);
  EXPECT_THAT(read_all(folder_, std::string(1000, 'P'), nullptr)->text, EndsWith("is no frame cache"));
}

TEST_F(HostileCache, DamageBehindRightHashesReadsNothingOutside) {
  std::minstd_rand random(2);
  int errors = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = good_;
    for (uint32_t flips = 1 + random() % 4; flips > 0; --flips) {
      // Half of the damage goes into the index, where sizes and offsets are.
      const size_t index = bytes.size() - kCacheFooterBytes - frames_.size() * kCacheEntryBytes - 200;
      const size_t at =
          random() % 2 == 0 ? random() % bytes.size() : index + random() % (bytes.size() - index);
      bytes[at] = static_cast<char>(bytes[at] ^ 1 << (random() % 8));
    }
    if (const size_t footer = bytes.size() - kCacheFooterBytes;
        Fields(std::string_view(bytes).substr(footer)).take(8) > footer)
      continue;
    errors += read_all(folder_, with_new_hashes(bytes), nullptr).has_value() ? 1 : 0;
  }
  EXPECT_GT(errors, 1000);
}

TEST_F(HostileCache, FramesThatDependOnNothingAreRefused) {
  // The first frame loses its flag of a key frame.
  const uint64_t offset = Fields(std::string_view(good_).substr(good_.size() - kCacheFooterBytes)).take(8);
  std::string bytes = good_;
  bytes[offset + 14] = 0;
  EXPECT_THAT(read_all(folder_, with_new_hashes(bytes), nullptr)->text,
              HasSubstr("do not follow each other"));
}

}  // namespace
}  // namespace tilepress
