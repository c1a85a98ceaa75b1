// A compressed surface gives every pixel back, in any order, for every scheme and format.
#include <gtest/gtest.h>

#include <span>

#include "surface_samples.h"
#include "tilepress/scheme.h"
#include "tilepress/simd.h"
#include "tilepress/surface_reader.h"

namespace tilepress {
namespace {

/// Every scheme of the registry whose frames are complete, and the options that change what memory holds.
std::vector<std::string> all_schemes() {
  std::vector<std::string> schemes;
  for (const SchemeInfo& info : scheme_registry())
    if (!info.needs_frame_before) schemes.push_back(info.name);
  for (const char* text :
       {"vdcp:fvc=2", "vdcp:fvc=1024", "dcp:fvc=16,ways=4", "hdcp:coverage=0.99", "dcp:coverage=1",
        "ras:ycocg=1", "ras:sizes=2", "ras:sizes=burst", "huffdcp:fvc=256"})
    schemes.push_back(text);
  return schemes;
}

struct Shape {
  uint32_t width, height;
};
constexpr Shape kShapes[] = {{1, 1}, {8, 8}, {9, 7}, {67, 129}, {130, 33}};
constexpr PixelFormat kFormats[] = {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565,
                                    PixelFormat::kRgb10a2};

std::vector<PixelFormat> formats_of(const std::string& scheme) {
  const SchemeInfo& info = *find_scheme(parse_scheme(scheme)->name);
  std::vector<PixelFormat> formats;
  for (const PixelFormat format : kFormats)
    if (info.supports(format)) formats.push_back(format);
  return formats;
}

TEST(SurfaceReader, RefusesASchemeThatDoesNotSupportTheFormat) {
  for (const char* scheme : {"intel8", "intel11", "amddcc", "freqvals", "hilo", "msaa"}) {
    CompressedSurface surface = compress(scheme, {mixed_frame(17, 9, PixelFormat::kRgba8, 1)}, {});
    SurfaceReader reader;
    ASSERT_TRUE(reader.open(surface, {})) << scheme;
    for (const PixelFormat format : {PixelFormat::kRgb10a2, PixelFormat::kRgb565}) {
      surface.format = format;
      surface.payload.resize(surface.blocks() * surface.slot_bytes());
      surface.block_bits.assign(surface.blocks(), 0);
      const auto opened = reader.open(surface, {});
      ASSERT_FALSE(opened) << scheme;
      EXPECT_EQ(opened.error().text, std::string("scheme ") + scheme + " does not support " +
                                         std::string(traits(format).name) + " surfaces");
    }
  }
}

class EverySchemeTest : public testing::TestWithParam<std::string> {};

TEST_P(EverySchemeTest, SequentialReadGivesEveryPixelOfEveryShapeAndFormat) {
  for (const PixelFormat format : formats_of(GetParam()))
    for (const Shape shape : kShapes) {
      const auto before = mixed_frame(shape.width, shape.height, format, 1);
      const auto frame = mixed_frame(shape.width, shape.height, format, 2);
      for (const auto& frames : {std::vector{frame}, std::vector{before, frame}}) {
        const CompressedSurface surface = compress(GetParam(), frames, {});
        SurfaceReader reader;
        ASSERT_TRUE(reader.open(surface, {}));
        std::vector<uint32_t> words;
        ASSERT_TRUE(reader.read_rect({0, 0, shape.width, shape.height}, words));
        EXPECT_EQ(words, frame.words) << shape.width << "x" << shape.height << " " << traits(format).name;
      }
    }
}

TEST_P(EverySchemeTest, RandomRectanglesAndPixelsEqualTheSequentialRead) {
  const auto frame = mixed_frame(67, 129, PixelFormat::kRgba8, 3);
  const CompressedSurface surface = compress(GetParam(), {frame, frame}, {});
  SurfaceReader reader;
  ASSERT_TRUE(reader.open(surface, {.csb_lines = 2, .csb_line_bursts = 1}));
  std::mt19937 random(5);
  std::vector<uint32_t> words;
  for (int i = 0; i < 200; ++i) {
    PixelRect rect;
    rect.x = static_cast<uint32_t>(random() % frame.width);
    rect.y = static_cast<uint32_t>(random() % frame.height);
    rect.width = 1 + static_cast<uint32_t>(random() % (frame.width - rect.x));
    rect.height = 1 + static_cast<uint32_t>(random() % (frame.height - rect.y));
    ASSERT_TRUE(reader.read_rect(rect, words));
    for (uint32_t y = 0; y < rect.height; ++y)
      for (uint32_t x = 0; x < rect.width; ++x)
        ASSERT_EQ(words[y * rect.width + x], frame.words[(rect.y + y) * frame.width + rect.x + x]);
    uint32_t word = 0;
    ASSERT_TRUE(reader.read_pixel(rect.x, rect.y, word));
    ASSERT_EQ(word, frame.words[rect.y * frame.width + rect.x]);
  }
}

TEST_P(EverySchemeTest, TheReaderFetchesTheBurstsThatTheEngineCounted) {
  for (const PixelFormat format : formats_of(GetParam()))
    for (const uint32_t burst_bits : {16u, 128u, 2048u}) {
      const auto frame = mixed_frame(67, 33, format, 4);
      SchemeStatistics statistics;
      const CompressedSurface surface =
          compress(GetParam(), {frame, frame}, {.burst_bits = burst_bits}, &statistics);
      SurfaceReader reader;
      ASSERT_TRUE(reader.open(surface, {}));
      std::vector<uint32_t> words;
      ASSERT_TRUE(reader.read_rect({0, 0, 67, 33}, words));
      EXPECT_EQ(reader.traffic().blocks, statistics.blocks);
      EXPECT_EQ(reader.traffic().payload_bursts, statistics.bursts);
      EXPECT_EQ(surface.csb_plane_bits(), statistics.csb_bits);
      EXPECT_EQ(surface.table_bits, statistics.palette_bits);
      uint64_t payload_bits = 0;
      for (const uint16_t bits : surface.block_bits) payload_bits += bits;
      EXPECT_EQ(payload_bits, statistics.payload_bits);
    }
}

/// The same frames into one surface, or into a new one each time.
TEST_P(EverySchemeTest, MemoryHoldsTheSameOnEveryTargetAndNothingOfFramesBefore) {
  const std::string_view target = simd_target();
  std::vector<SampleFrame> frames;
  for (uint32_t seed = 1; seed <= 6; ++seed)
    frames.push_back(mixed_frame(67, 33, PixelFormat::kRgba8, 1 + seed / 2));  // some in a row are alike
  std::vector<CompressedSurface> wanted;
  for (const std::string_view each : simd_targets()) {
    SCOPED_TRACE(each);
    force_simd_target(each);
    SurfaceEngine into_one({*parse_scheme(GetParam())}, {}), into_new({*parse_scheme(GetParam())}, {});
    CompressedSurface one;
    FrameStatistics out;
    for (size_t i = 0; i < frames.size(); ++i) {
      CompressedSurface fresh;
      into_one.process(frames[i].view(), out, std::span(&one, 1));
      into_new.process(frames[i].view(), out, std::span(&fresh, 1));
      if (wanted.size() == i) wanted.push_back(fresh);
      for (const CompressedSurface* surface : {&one, &fresh}) {
        EXPECT_EQ(surface->payload, wanted[i].payload) << "frame " << i;
        EXPECT_EQ(surface->csb, wanted[i].csb) << "frame " << i;
        EXPECT_EQ(surface->tables, wanted[i].tables) << "frame " << i;
        EXPECT_EQ(surface->block_bits, wanted[i].block_bits) << "frame " << i;
      }
    }
  }
  force_simd_target(target);
}

TEST_P(EverySchemeTest, DamagedSurfacesAreReadOrRefusedButNeverWander) {
  const auto frame = mixed_frame(40, 24, PixelFormat::kRgba8, 6);
  const CompressedSurface whole = compress(GetParam(), {frame, frame}, {});
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    CompressedSurface surface = whole;
    for (const std::span<uint8_t> plane :
         {std::span<uint8_t>(surface.payload), std::span(surface.csb), std::span(surface.tables)})
      for (int n = 0; n < 3 && !plane.empty(); ++n)
        plane[random() % plane.size()] ^= static_cast<uint8_t>(1 + random() % 255);
    SurfaceReader reader;
    Block block;
    if (const auto opened = reader.open(surface, {}); !opened) {
      EXPECT_FALSE(opened.error().text.empty());
      continue;
    }
    for (uint32_t by = 0; by < surface.blocks_y(); ++by)
      for (uint32_t bx = 0; bx < surface.blocks_x(); ++bx) reader.read_block(bx, by, block);
    EXPECT_LE(reader.traffic().payload_bursts, reader.traffic().raw_bursts) << "read beyond a slot";
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, EverySchemeTest, testing::ValuesIn(all_schemes()), [](const auto& named) {
  std::string name = named.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST(CompressedSurface, OutsideOfTheSurfaceThereIsNothing) {
  const auto frame = mixed_frame(20, 12, PixelFormat::kRgba8, 1);
  const CompressedSurface surface = compress("vdcp", {frame}, {});
  SurfaceReader reader;
  Block block;
  uint32_t word = 0;
  std::vector<uint32_t> words;
  EXPECT_FALSE(reader.read_pixel(0, 0, word)) << "nothing is open";
  ASSERT_TRUE(reader.open(surface, {}));
  EXPECT_TRUE(reader.read_block(2, 1, block));
  EXPECT_FALSE(reader.read_block(3, 0, block));
  EXPECT_FALSE(reader.read_block(0, 2, block));
  EXPECT_FALSE(reader.read_pixel(20, 0, word));
  EXPECT_FALSE(reader.read_pixel(0, 12, word));
  EXPECT_FALSE(reader.read_rect({0, 0, 21, 1}, words));
  EXPECT_FALSE(reader.read_rect({1, 0, UINT32_MAX, 1}, words));
  EXPECT_FALSE(reader.read_rect({0, 0, 0, 1}, words));
}

TEST(CompressedSurface, TheSlotOfARawBlockHasTheFormatsSize) {
  CompressedSurface surface;
  surface.format = PixelFormat::kRgba8;
  EXPECT_EQ(surface.slot_bytes(), 256u) << "64 pixels of 4 bytes";
  surface.format = PixelFormat::kRgb565;
  EXPECT_EQ(surface.slot_bytes(), 128u) << "64 pixels of 2 bytes";
  surface.burst_bits = 2048;
  EXPECT_EQ(surface.slot_bytes(), 256u) << "one whole burst";
}

TEST(CompressedSurface, SlotsBeginWithACacheLine) {
  for (const uint32_t side : {8u, 72u, 1000u}) {
    const auto frame = mixed_frame(side, side, PixelFormat::kRgb565, 1);
    const CompressedSurface surface = compress("vdcp", {frame}, {}), copy = surface;
    for (const auto* each : {&surface, &copy})
      EXPECT_EQ(reinterpret_cast<uintptr_t>(each->payload.data()) % 64, 0u) << side;
  }
}

TEST(CompressedSurface, SurfacesOfImpossibleShapeAreRefusedWithAReason) {
  const auto frame = mixed_frame(16, 8, PixelFormat::kRgba8, 1);
  const CompressedSurface whole = compress("vdcp", {frame, frame}, {});
  SurfaceReader reader;
  const auto refused = [&](auto&& damage) {
    CompressedSurface surface = whole;
    damage(surface);
    const auto opened = reader.open(surface, {});
    return !opened && !opened.error().text.empty();
  };
  EXPECT_TRUE(refused([](auto& s) { s.width = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.height = 70000; }));
  EXPECT_TRUE(refused([](auto& s) { s.width = 24; }));
  EXPECT_TRUE(refused([](auto& s) { s.burst_bits = 100; }));
  EXPECT_TRUE(refused([](auto& s) { s.burst_bits = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.tile_side = 12; }));
  EXPECT_TRUE(refused([](auto& s) { s.csb_bits = 16; }));
  EXPECT_TRUE(refused([](auto& s) { s.table_bits = 33 * 3, s.tables.resize(13); }));
  EXPECT_TRUE(refused([](auto& s) { s.payload.pop_back(); }));
  EXPECT_TRUE(refused([](auto& s) { s.scheme.name = "none"; }));
  EXPECT_TRUE(refused([](auto& s) { s.format = static_cast<PixelFormat>(77); }));
  EXPECT_TRUE(refused([](auto& s) { s.format = PixelFormat::kRgba16f; }));
}

}  // namespace
}  // namespace tilepress
