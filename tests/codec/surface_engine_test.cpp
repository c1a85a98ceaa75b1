// Surface engine on hand-made frames: dictionaries from earlier frames, padding, accounting, frame metrics.
#include "tilepress/surface_engine.h"

#include <gtest/gtest.h>

#include <thread>

#include "surface_patterns.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

using namespace tilepress;
using reference::Picture;

namespace {

constexpr uint32_t A = 0xFF000001, B = 0xFF000002, C = 0xFF000003, D = 0xFF000004;

Picture solid(uint32_t width, uint32_t height, uint32_t color) {
  return {width, height, std::vector<uint32_t>(size_t{width} * height, color)};
}

/// One scheme on one surface.
class Surface {
 public:
  explicit Surface(const std::string& scheme, ModelOptions options = {})
      : engine_({parse(scheme)}, options) {}
  const FrameStatistics& next(const Picture& picture) {
    engine_.process(patterns::in_memory(picture).view(), statistics_);
    return statistics_;
  }
  const SchemeStatistics& scheme(const Picture& picture) { return next(picture).schemes[0]; }

 private:
  static SchemeSpec parse(const std::string& text) { return *parse_scheme(text); }
  SurfaceEngine engine_;
  FrameStatistics statistics_;
};

}  // namespace

TEST(Engine, TheDictionaryOfAFrameComesFromTheFrameBefore) {
  Surface surface("dcp");
  EXPECT_EQ(surface.scheme(solid(8, 8, A)).payload_bits, 2048u);  // nothing known yet
  EXPECT_EQ(surface.scheme(solid(8, 8, A)).payload_bits, 384u);   // 64 · 6
  EXPECT_EQ(surface.scheme(solid(8, 8, B)).payload_bits, 2048u);  // B was not in the frame before
  EXPECT_EQ(surface.scheme(solid(8, 8, B)).payload_bits, 384u);
  EXPECT_EQ(surface.scheme(solid(8, 8, A)).payload_bits, 2048u);  // and A no longer is
}

TEST(Engine, WithAPeriodTheDictionaryServesUntilTheNextCollectingFrameIsOver) {
  Surface surface("dcp:period=2");
  surface.next(solid(8, 8, A));                                   // frame 0 collects A
  EXPECT_EQ(surface.scheme(solid(8, 8, B)).payload_bits, 2048u);  // frame 1
  EXPECT_EQ(surface.scheme(solid(8, 8, B)).payload_bits, 2048u);  // frame 2 collects B, compresses with A
  EXPECT_EQ(surface.scheme(solid(8, 8, B)).payload_bits, 384u);   // frame 3
}

TEST(Engine, TheFirstFrameIsWarmUpForEveryScheme) {
  for (const char* name : {"dcp", "ras", "red", "hdcp"}) {
    Surface surface(name);
    EXPECT_TRUE(surface.next(solid(8, 8, A)).warmup) << name;
    EXPECT_FALSE(surface.next(solid(8, 8, A)).warmup) << name;
  }
}

TEST(Engine, PaddingNeverEntersTheFvc) {
  // 10×1 pixels: eight A, then B and C. B and C are seen once each, in this order: indices 1 and 2. Were the
  // padded block counted, C would be seen 56 times and come second.
  Picture picture = solid(10, 1, A);
  picture.words[8] = B;
  picture.words[9] = C;
  Surface surface("vdcp");
  surface.next(picture);
  const SchemeStatistics& scheme = surface.scheme(picture);
  EXPECT_EQ(scheme.blocks, 2u);
  EXPECT_EQ(scheme.raw_bits, 2u * 2048);
  EXPECT_EQ(scheme.payload_bits,
            16u * 8);  // block 0: index 0 only; block 1: two bits for each of its 64 pixels
}

TEST(Engine, BurstsAreRoundedUpPerBlock) {
  // Frame 1: 15 sub-blocks of A in 24 bits, one raw: 128 + 360 = 488 bits, 3.8 bursts of 128.
  Picture picture = solid(8, 8, A);
  for (const uint32_t bits : {128u, 256u, 2048u}) {
    ModelOptions options;
    options.burst_bits = bits;
    Surface surface("dcp", options);
    picture.words[0] = A;
    surface.next(picture);
    picture.words[0] = D;
    const SchemeStatistics& scheme = surface.scheme(picture);
    EXPECT_EQ(scheme.payload_bits, 488u);
    EXPECT_EQ(scheme.bursts, bits == 128 ? 4u : bits == 256 ? 2u : 1u);
    EXPECT_EQ(scheme.moved_bits(), scheme.bursts * bits + 16 + 64 * 33);
  }
}

TEST(Engine, RatesCountWhatTheirDefinitionsSay) {
  Surface surface("vdcp");
  surface.next(solid(8, 8, A));
  const SchemeStatistics& scheme = surface.scheme(solid(8, 8, A));
  EXPECT_EQ(scheme.payload_bits, 0u);
  EXPECT_EQ(scheme.bursts, 0u);
  EXPECT_EQ(scheme.csb_bits, 48u);
  EXPECT_EQ(scheme.palette_bits, 2112u);
  EXPECT_DOUBLE_EQ(scheme.rate_payload(), 2048.0 / 48);
  EXPECT_DOUBLE_EQ(scheme.rate(), 2048.0 / (48 + 2112));
}

TEST(Engine, CoverageDecidesAgainstTheFrameTheDictionaryCameFrom) {
  // 128 different colours in 128 pixels: the FVC holds 64 at one each, coverage 0.5.
  Picture many = solid(16, 8, 0);
  for (uint32_t i = 0; i < 128; ++i) many.words[i] = i;
  Surface on("dcp:coverage=0.5"), off("dcp:coverage=0.51");
  on.next(many);
  off.next(many);
  EXPECT_EQ(on.scheme(many).csb_bits, 2u * 16);
  EXPECT_EQ(off.scheme(many).csb_bits, 0u);
  EXPECT_EQ(off.scheme(solid(16, 8, A)).payload_bits, 2u * 2048);  // still the dictionary of a poor frame
  EXPECT_EQ(off.scheme(solid(16, 8, A)).payload_bits, 2u * 384);   // now that of a good one
}

TEST(Engine, CountsTheBlocksOfEachHalfOfTheHybrid) {
  Picture picture = solid(16, 8, A);
  Surface surface("hdcp");
  const SchemeStatistics& first = surface.scheme(picture);
  EXPECT_EQ(first.own[1], 2u);  // no dictionary: RAS does better
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 8; x < 16; ++x) picture.words[16 * y + x] = 0xFF000100 + x;  // a ramp of new colours
  const SchemeStatistics& second = surface.scheme(picture);
  EXPECT_EQ(second.own[0], 1u);
  EXPECT_EQ(second.own[1], 1u);
  EXPECT_EQ(second.own[2], 0u);
  uint32_t state = 1;
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 8; x < 16; ++x) picture.words[16 * y + x] = state = state * 1664525 + 1013904223;
  const SchemeStatistics& third = surface.scheme(picture);  // noise is raw in both; VDCP wins the tie
  EXPECT_EQ(third.own[0], 2u);
  EXPECT_EQ(third.own[2], 1u);
}

TEST(Engine, TellsTheFiguresOfEachFvcInTheFramesThatItCollected) {
  ModelOptions options;
  options.frame_metrics = true;
  SurfaceEngine engine({*parse_scheme("vdcp:fvc=2,period=2"), *parse_scheme("dcp"), *parse_scheme("ras")},
                       options);
  // 96 pixels of A, 24 of B, 8 of C. C comes last and takes the entry of B, so that two entries hold A and C.
  Picture picture = solid(16, 8, A);
  for (uint32_t i = 0; i < 24; ++i) picture.words[16 * (i / 8) + 8 + i % 8] = B;
  for (uint32_t i = 0; i < 8; ++i) picture.words[16 * 7 + 8 + i] = C;
  FrameStatistics frame;
  for (const bool collects : {true, false, true}) {
    engine.process(patterns::in_memory(picture).view(), frame);
    ASSERT_EQ(frame.schemes[0].fvc.has_value(), collects);
    if (collects) {
      EXPECT_EQ(frame.schemes[0].fvc->coverage, 104.0 / 128);
      EXPECT_EQ(frame.schemes[0].fvc->relative_coverage, 104.0 / 120);
    }
    ASSERT_TRUE(frame.schemes[1].fvc.has_value());
    EXPECT_EQ(frame.schemes[1].fvc->coverage, 1.0);
    EXPECT_EQ(frame.schemes[1].fvc->relative_coverage, 1.0);
    EXPECT_FALSE(frame.schemes[2].fvc.has_value());
  }
}

TEST(Engine, SixteenBitSurfacesCountSixteenBitPixels) {
  SurfaceEngine engine({*parse_scheme("dcp"), *parse_scheme("red")}, {});
  FrameStatistics statistics;
  const Picture picture = solid(8, 8, 0xF81F);
  for (int frame = 0; frame < 2; ++frame)
    engine.process(patterns::in_memory(picture, PixelFormat::kRgb565).view(), statistics);
  EXPECT_EQ(statistics.schemes[0].raw_bits, 1024u);
  EXPECT_EQ(statistics.schemes[0].payload_bits, 384u);
  EXPECT_EQ(statistics.schemes[0].palette_bits, 64u * 17);
  EXPECT_EQ(statistics.schemes[1].payload_bits, 8u * 16);
}

TEST(Metrics, OfFourPixels) {
  Surface surface("red");
  const FrameMetrics first = surface.next({2, 2, {A, A, B, C}}).metrics;
  EXPECT_EQ(first.unique_colors, 3u);
  EXPECT_DOUBLE_EQ(first.entropy, 1.5);  // ½·1 + 2·¼·2
  EXPECT_EQ(first.pixel_change, 0.0);
  EXPECT_EQ(first.color_change, 0.0);
  EXPECT_EQ(first.fvc_coverage, 1.0);
  EXPECT_EQ(first.fvc_relative_coverage, 1.0);
  EXPECT_EQ(first.top100_coverage, 1.0);
  // Now A three times, B once: three positions differ; A gained one, C lost one: ½ · 2 / 4.
  const FrameMetrics second = surface.next({2, 2, {B, A, A, A}}).metrics;
  EXPECT_EQ(second.unique_colors, 2u);
  EXPECT_DOUBLE_EQ(second.pixel_change, 0.75);
  EXPECT_DOUBLE_EQ(second.color_change, 0.25);
}

TEST(Metrics, CoverageIsWhatTheFvcStillHolds) {
  // A column of 64 colours once each, then X and Y ten times in turn. Each evicts the other from slot 0, at
  // count 1. Held at the end: 63 colours and Y, 64 counts of 84 pixels. True counts of those: 63 + 10 = 73;
  // the 64 most frequent have 10 + 10 + 62 = 82.
  Picture picture{1, 84, {}};
  for (uint32_t i = 0; i < 64; ++i) picture.words.push_back(0x1000 + i);
  for (uint32_t i = 0; i < 10; ++i) picture.words.insert(picture.words.end(), {A, B});
  Surface surface("red");
  const FrameMetrics metrics = surface.next(picture).metrics;
  EXPECT_EQ(metrics.unique_colors, 66u);
  EXPECT_DOUBLE_EQ(metrics.fvc_coverage, 64.0 / 84);
  EXPECT_DOUBLE_EQ(metrics.fvc_relative_coverage, 73.0 / 82);
  EXPECT_DOUBLE_EQ(metrics.top100_coverage, 1.0);
}

TEST(Metrics, Top100IsTheShareOfAHundredColours) {
  // 200 colours; 50 of them twice: 100 + 50 of 250 pixels are in the hundred most frequent.
  Picture picture{250, 1, {}};
  for (uint32_t i = 0; i < 250; ++i) picture.words.push_back(i % 200);
  Surface surface("red");
  EXPECT_DOUBLE_EQ(surface.next(picture).metrics.top100_coverage, 150.0 / 250);
}

TEST(Metrics, DoNotDependOnTheSchemesFvc) {
  Picture picture = patterns::draw(patterns::kSkewed, 40, 40, PixelFormat::kRgba8, 3);
  Surface plain("red"), other("vdcp:fvc=16,sample=7,period=3,policy=lru");
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(plain.next(picture).metrics.fvc_coverage, other.next(picture).metrics.fvc_coverage);
    picture.words[static_cast<size_t>(frame)] ^= 0xFFFF;
  }
}

TEST(Engine, ABlockTakesInRasWhatItTakesWhicheverFramesCameBefore) {
  // 21 × 13: the last column and row of blocks are padded. One pixel changes at a time, or none, or all.
  patterns::Dice dice(5);
  Picture picture = patterns::draw(patterns::kGradient, 21, 13, PixelFormat::kRgba8, 1);
  Surface plain("ras"), ycocg("ras:ycocg=1");
  for (int frame = 0; frame < 200; ++frame) {
    SCOPED_TRACE(frame);
    if (frame % 50 == 49) picture = patterns::draw(patterns::kNoise, 21, 13, PixelFormat::kRgba8, frame);
    if (frame % 3 != 0) picture.words[dice.below(21 * 13)] ^= 1u << dice.below(32);
    Surface new_plain("ras"), new_ycocg("ras:ycocg=1");
    EXPECT_EQ(plain.scheme(picture).payload_bits, new_plain.scheme(picture).payload_bits);
    EXPECT_EQ(ycocg.scheme(picture).payload_bits, new_ycocg.scheme(picture).payload_bits);
  }
}

TEST(Engine, WithoutMetricsAFrameCountsWhereverItLies) {
  // Whole blocks in RGBA order are read where they lie; other order, rows that are not words, or upside down,
  // from a copy. The memory of a frame is gone when the next one comes.
  const std::vector<SchemeSpec> specs = {*parse_scheme("vdcp"), *parse_scheme("huffdcp"),
                                         *parse_scheme("te")};
  ModelOptions options;
  options.frame_metrics = false;
  SurfaceEngine tight(specs, options), padded(specs, options), other_order(specs, options),
      upside_down(specs, options), odd_rows(specs, options), mixed(specs, options);
  for (uint32_t frame = 0; frame < 5; ++frame) {
    const Picture picture = patterns::draw(patterns::kRectangles, 104, 72, PixelFormat::kRgba8, frame);
    const auto statistics_of = [&](SurfaceEngine& engine, ByteOrder order, bool bottom_up, uint32_t padding) {
      const patterns::MemorySurface memory(picture, PixelFormat::kRgba8, order, bottom_up, padding);
      FrameStatistics statistics;
      engine.process(memory.view(), statistics);
      return statistics;
    };
    const FrameStatistics expected = statistics_of(upside_down, ByteOrder::kRgba, true, 0);
    const FrameStatistics found[] = {statistics_of(tight, ByteOrder::kRgba, false, 0),
                                     statistics_of(padded, ByteOrder::kRgba, false, 64),
                                     statistics_of(other_order, ByteOrder::kBgra, false, 0),
                                     statistics_of(odd_rows, ByteOrder::kRgba, false, 3),
                                     statistics_of(mixed, ByteOrder::kRgba, frame % 2 == 0, 0)};
    for (const FrameStatistics& statistics : found)
      for (size_t i = 0; i < specs.size(); ++i) {
        EXPECT_EQ(statistics.schemes[i].payload_bits, expected.schemes[i].payload_bits);
        EXPECT_EQ(statistics.schemes[i].bursts, expected.schemes[i].bursts);
        EXPECT_EQ(statistics.schemes[i].extra_bits, expected.schemes[i].extra_bits);
      }
  }
}

TEST(Engine, BlocksOfOneColourCountAsIfEachWereMeasured) {
  // With verify each is. More colours than are kept at a time, runs of one, and blocks of two between them.
  std::vector<SchemeSpec> specs;
  for (const char* scheme : {"dcp", "adcp", "vdcp", "vdcp:fvc=2", "huffdcp", "ras", "red", "hdcp", "bdi"})
    specs.push_back(*parse_scheme(scheme));
  ModelOptions options, measuring_each;
  measuring_each.verify = true;
  SurfaceEngine engine(specs, options), measured(specs, measuring_each);
  BlockBits bits, wanted_bits;
  engine.note_block_bits(&bits);
  measured.note_block_bits(&wanted_bits);
  std::vector<CompressedSurface> surfaces(specs.size()), wanted_surfaces(specs.size());
  patterns::Dice dice(8);
  for (int frame = 0; frame < 6; ++frame) {
    Picture picture = solid(8 * 40, 8 * 20, 0);
    uint32_t color = 0;
    for (uint32_t by = 0; by < 20; ++by)
      for (uint32_t bx = 0; bx < 40; ++bx) {
        if (dice.below(3) == 0) color = 0xFF000000 | dice.below(frame % 2 == 0 ? 100 : 20) * 0x010305;
        for (uint32_t y = 0; y < 8; ++y)
          for (uint32_t x = 0; x < 8; ++x) picture.words[(by * 8 + y) * 320 + bx * 8 + x] = color;
        if (dice.below(5) == 0) picture.words[by * 8 * 320 + bx * 8 + dice.below(8)] ^= 0x50;
      }
    FrameStatistics found, wanted;
    engine.process(patterns::in_memory(picture).view(), found, surfaces);
    measured.process(patterns::in_memory(picture).view(), wanted, wanted_surfaces);
    for (size_t i = 0; i < specs.size(); ++i) {
      SCOPED_TRACE(specs[i].name + ", frame " + std::to_string(frame));
      EXPECT_EQ(wanted.schemes[i].mismatched_blocks, 0u);
      EXPECT_EQ(found.schemes[i].payload_bits, wanted.schemes[i].payload_bits);
      EXPECT_EQ(found.schemes[i].bursts, wanted.schemes[i].bursts);
      EXPECT_EQ(found.schemes[i].extra_bits, wanted.schemes[i].extra_bits);
      EXPECT_EQ(found.schemes[i].own, wanted.schemes[i].own);
      EXPECT_EQ(bits.schemes[i], wanted_bits.schemes[i]);
      EXPECT_EQ(surfaces[i].payload, wanted_surfaces[i].payload);
      EXPECT_EQ(surfaces[i].csb, wanted_surfaces[i].csb);
      EXPECT_EQ(surfaces[i].block_bits, wanted_surfaces[i].block_bits);
    }
    EXPECT_EQ(found.metrics.fvc_coverage, wanted.metrics.fvc_coverage);
    EXPECT_EQ(found.metrics.entropy, wanted.metrics.entropy);
  }
}

TEST(Engine, InStepsItGivesWhatItGivesAtOnce) {
  // The palette wants the whole frame before its first block.
  for (const char* schemes : {"vdcp", "palette"}) {
    const std::vector<SchemeSpec> specs = {*parse_scheme(schemes), *parse_scheme("hdcp")};
    SurfaceEngine at_once(specs, {}), in_steps(specs, {});
    FrameStatistics expected, found;
    for (int frame = 0; frame < 4; ++frame) {
      const Picture picture = patterns::draw(patterns::kSkewed, 100, 90, PixelFormat::kRgba8, frame);
      const auto memory = patterns::in_memory(picture);
      at_once.process(memory.view(), expected);
      in_steps.begin(memory.view(), found);
      int steps = 1;
      bool more = true;
      while (more) {  // each in another thread
        std::thread([&] { more = in_steps.advance(); }).join();
        steps += more;
      }
      EXPECT_EQ(steps, 3) << "90 rows are three rows of tiles";
      for (size_t i = 0; i < specs.size(); ++i) {
        EXPECT_EQ(found.schemes[i].payload_bits, expected.schemes[i].payload_bits);
        EXPECT_EQ(found.schemes[i].csb_bits, expected.schemes[i].csb_bits);
        EXPECT_EQ(found.schemes[i].bursts, expected.schemes[i].bursts);
      }
      EXPECT_EQ(found.metrics.unique_colors, expected.metrics.unique_colors);
      EXPECT_EQ(found.metrics.pixel_change, expected.metrics.pixel_change);
      EXPECT_EQ(found.metrics.fvc_coverage, expected.metrics.fvc_coverage);
      EXPECT_GT(found.encode_ns, 0u);
    }
  }
}
