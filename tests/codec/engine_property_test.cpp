// Properties of the surface engine over random and adversarial surfaces, with every scheme and option.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "reference_model.h"
#include "surface_patterns.h"
#include "tilepress/scheme.h"
#include "tilepress/simd.h"
#include "tilepress/surface_engine.h"

using namespace tilepress;
using patterns::Picture;

namespace {

SchemeSpec spec(const std::string& text) {
  const auto parsed = parse_scheme(text);
  if (!parsed) throw std::runtime_error(parsed.error().text);
  return *parsed;
}

/// Everything a sequence of frames depends on, drawn by rapidcheck.
struct Trial {
  uint32_t width, height, tile_side, burst_bits;
  PixelFormat format;
  ByteOrder order;
  bool bottom_up;
  uint32_t row_padding;
  std::vector<SchemeSpec> schemes;
  std::vector<Picture> frames;
};

std::string fvc_keys() {
  const uint32_t entries = 1u << *rc::gen::inRange(1, 11);
  std::ostringstream keys;
  keys << "fvc=" << entries;
  keys << ",policy=" << *rc::gen::element<std::string>("lfc", "2lfc", "lru", "random");
  if (*rc::gen::arbitrary<bool>()) keys << ",ways=" << std::max(1u, entries >> *rc::gen::inRange(0, 4));
  if (*rc::gen::arbitrary<bool>()) keys << ",sample=" << *rc::gen::element(1, 2, 3, 7, 16, 64, 1000);
  if (*rc::gen::arbitrary<bool>()) keys << ",period=" << *rc::gen::element(1, 2, 3);
  if (*rc::gen::arbitrary<bool>()) keys << ",coverage=" << *rc::gen::element<std::string>("0.5", "0.9", "1");
  return keys.str();
}

std::vector<SchemeSpec> any_schemes(bool eight_bit) {
  const std::string keys = fvc_keys();
  std::vector<SchemeSpec> schemes = default_schemes();
  for (const char* name : {"dcp", "adcp", "vdcp", "huffdcp", "hdcp"})
    schemes.push_back(spec(std::string(name) + ":" + keys));
  schemes.push_back(spec("vdcp:" + fvc_keys()));
  for (const char* text : {"ras:ycocg=1", "ras:sizes=2", "ras:sizes=burst", "ras:ycocg=1,sizes=burst",
                           "palette", "palette:entries=8", "fbc", "fbc:entries=512", "te", "bdi",
                           "bdi:order=quad", "bpc", "bpc:order=quad"})
    schemes.push_back(spec(text));
  if (eight_bit)
    for (const char* text :
         {"fpc", "fpc:order=quad", "fpcd", "cpack", "cpack:order=quad", "freqvals",
          "freqvals:fvc=16,policy=lru,sample=3,period=2", "hilo", "msaa", "intel8", "intel11", "amddcc"})
      schemes.push_back(spec(text));
  return schemes;
}

Trial any_trial(const std::vector<PixelFormat>& formats, int largest_width, int largest_height) {
  Trial trial;
  trial.width = *rc::gen::inRange(1, largest_width + 1);
  trial.height = *rc::gen::inRange(1, largest_height + 1);
  if (*rc::gen::arbitrary<bool>()) {  // whole blocks
    trial.width = (trial.width + 7) / 8 * 8;
    trial.height = (trial.height + 7) / 8 * 8;
  }
  trial.tile_side = *rc::gen::element(8, 16, 32, 64, 24);
  trial.burst_bits = *rc::gen::element(128, 256, 64, 512, 2048, 16);
  trial.format = *rc::gen::elementOf(formats);
  const bool eight_bit = trial.format == PixelFormat::kRgba8 || trial.format == PixelFormat::kRgbx8;
  trial.order = eight_bit && *rc::gen::arbitrary<bool>() ? ByteOrder::kBgra : ByteOrder::kRgba;
  trial.bottom_up = *rc::gen::arbitrary<bool>();
  trial.row_padding = *rc::gen::element(0, 4, 64);
  trial.schemes = any_schemes(eight_bit);
  force_simd_target(*rc::gen::elementOf(simd_targets()));  // every instruction set gives the same bits
  const auto pattern =
      static_cast<uint32_t>(*rc::gen::resize(100, rc::gen::inRange<int>(0, patterns::kPatternCount)));
  const auto seed = *rc::gen::inRange<uint32_t>(0, 1000000);
  const int frame_count = *rc::gen::resize(100, rc::gen::inRange(2, 6));
  patterns::Dice dice(seed);
  trial.frames.push_back(patterns::draw(pattern, trial.width, trial.height, trial.format, seed));
  while (static_cast<int>(trial.frames.size()) < frame_count)
    trial.frames.push_back(patterns::follow(trial.frames.back(), trial.format, dice));
  return trial;
}

ModelOptions model(const Trial& trial, bool verify) {
  ModelOptions options;
  options.tile_side = trial.tile_side;
  options.burst_bits = trial.burst_bits;
  options.verify = verify;
  return options;
}

void process(SurfaceEngine& engine, const Trial& trial, const Picture& picture, FrameStatistics& out) {
  const patterns::MemorySurface surface(picture, trial.format, trial.order, trial.bottom_up,
                                        trial.row_padding);
  engine.process(surface.view(), out);
}

const std::vector<PixelFormat> kAllFormats = {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565,
                                              PixelFormat::kRgb10a2};

/// The engine and the reference model side by side over one trial.
class Comparison {
 public:
  explicit Comparison(const Trial& trial)
      : trial_(trial), engine_(trial.schemes, model(trial, false)), meter_(trial.format, trial.tile_side) {
    for (const SchemeSpec& scheme : trial.schemes)
      expected_.emplace_back(scheme, trial.format, trial.tile_side, trial.burst_bits);
    ModelOptions options = model(trial, false);
    options.frame_metrics = false;
    for (size_t i = 0; i < trial.schemes.size(); ++i)
      alone_.emplace_back(std::vector<SchemeSpec>{trial.schemes[i]}, options);
  }
  /// What differs in the next frame; empty if nothing does.
  std::string next(const Picture& picture) {
    FrameStatistics actual;
    process(engine_, trial_, picture, actual);
    std::ostringstream out;
    for (size_t i = 0; i < trial_.schemes.size(); ++i) {
      const SchemeStatistics& scheme = actual.schemes[i];
      const reference::Figures figures = expected_[i].frame(picture);
      const std::string at = " (" + trial_.schemes[i].text + ")";
      exact(out, "payload_bits" + at, scheme.payload_bits, figures.payload_bits);
      exact(out, "bursts" + at, scheme.bursts, figures.bursts);
      exact(out, "csb_bits" + at, scheme.csb_bits, figures.csb_bits);
      exact(out, "palette_bits" + at, scheme.palette_bits, figures.palette_bits);
      exact(out, "extra_bits" + at, scheme.extra_bits, figures.extra_bits);
      FrameStatistics alone;
      process(alone_[i], trial_, picture, alone);
      exact(out, "payload_bits alone" + at, alone.schemes[0].payload_bits, figures.payload_bits);
      exact(out, "bursts alone" + at, alone.schemes[0].bursts, figures.bursts);
      exact(out, "extra_bits alone" + at, alone.schemes[0].extra_bits, figures.extra_bits);
    }
    const reference::Metrics metrics = meter_.frame(picture);
    exact(out, "unique_colors", actual.metrics.unique_colors, metrics.unique_colors);
    close(out, "entropy", actual.metrics.entropy, metrics.entropy);
    close(out, "pixel_change", actual.metrics.pixel_change, metrics.pixel_change);
    close(out, "color_change", actual.metrics.color_change, metrics.color_change);
    close(out, "fvc_coverage", actual.metrics.fvc_coverage, metrics.fvc_coverage);
    close(out, "fvc_relative_coverage", actual.metrics.fvc_relative_coverage, metrics.fvc_relative_coverage);
    close(out, "top100_coverage", actual.metrics.top100_coverage, metrics.top100_coverage);
    if (out.str().empty()) return {};
    return std::to_string(trial_.width) + "x" + std::to_string(trial_.height) + ", tile " +
           std::to_string(trial_.tile_side) + ", burst " + std::to_string(trial_.burst_bits) + ":" +
           out.str();
  }

 private:
  static void exact(std::ostream& out, const std::string& what, uint64_t engine, uint64_t reference) {
    if (engine != reference) out << "\n  " << what << ": engine " << engine << ", reference " << reference;
  }
  static void close(std::ostream& out, const char* what, double engine, double reference) {
    if (!(std::abs(engine - reference) <= 1e-9 * (1 + std::abs(reference))))
      out << "\n  " << what << ": engine " << engine << ", reference " << reference;
  }
  const Trial& trial_;
  SurfaceEngine engine_;
  std::vector<SurfaceEngine> alone_;  ///< a scheme each, and no metrics: no copy of a frame may be needed
  std::vector<reference::Scheme> expected_;
  reference::Meter meter_;
};

RC_GTEST_PROP(EngineProperty, EqualsTheReferenceModelInEveryFigure, ()) {
  const Trial trial = any_trial(kAllFormats, 67, 129);
  Comparison comparison(trial);
  for (const Picture& picture : trial.frames) {
    const std::string difference = comparison.next(picture);
    if (!difference.empty()) RC_FAIL(difference);
  }
}

/// Every pattern and the sizes that sit on, before and after the edges of blocks and tiles.
TEST(EngineOnAwkwardSurfaces, EqualsTheReferenceModel) {
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 1},   {1, 9},   {7, 8},   {9, 7},
                                                 {33, 31}, {64, 40}, {67, 129}};
  const char* texts[] = {"vdcp:fvc=2,policy=2lfc,ways=1",
                         "dcp:fvc=1024,policy=lru",
                         "huffdcp:fvc=16,policy=2lfc",
                         "vdcp:fvc=32,policy=random,ways=4",
                         "hdcp:coverage=0.9,period=2",
                         "adcp:sample=3",
                         "ras:sizes=burst",
                         "ras:ycocg=1",
                         "palette",
                         "fbc",
                         "te",
                         "bdi",
                         "bpc",
                         "fpc",
                         "fpcd",
                         "cpack",
                         "freqvals",
                         "hilo",
                         "msaa",
                         "intel8",
                         "intel11",
                         "amddcc"};
  Trial trial{};
  trial.burst_bits = 128;
  trial.format = PixelFormat::kRgba8;
  trial.schemes = default_schemes();
  for (const char* text : texts) trial.schemes.push_back(spec(text));
  for (const auto& [width, height] : sizes)
    for (uint32_t pattern = 0; pattern < patterns::kPatternCount; ++pattern) {
      trial.width = width;
      trial.height = height;
      trial.tile_side = pattern % 2 == 0 ? 32 : 64;
      force_simd_target(simd_targets()[pattern % simd_targets().size()]);
      Comparison comparison(trial);
      for (uint64_t frame = 0; frame < 3; ++frame) {
        const Picture picture = patterns::draw(pattern, width, height, trial.format, 5 + frame / 2);
        EXPECT_EQ(comparison.next(picture), "") << "pattern " << pattern << ", frame " << frame;
      }
    }
}

RC_GTEST_PROP(EngineProperty, EveryBlockOfEverySchemeComesBackFromItsBits, ()) {
  const Trial trial = any_trial(kAllFormats, 40, 40);
  SurfaceEngine engine(trial.schemes, model(trial, true));
  FrameStatistics statistics;
  const uint64_t blocks = uint64_t{(trial.width + 7) / 8} * ((trial.height + 7) / 8);
  for (const Picture& picture : trial.frames) {
    process(engine, trial, picture, statistics);
    for (size_t i = 0; i < trial.schemes.size(); ++i) {
      RC_LOG() << trial.schemes[i].text << " " << traits(trial.format).name << "\n";
      RC_ASSERT(statistics.schemes[i].checked_blocks == blocks);
      RC_ASSERT(statistics.schemes[i].mismatched_blocks == 0u);
    }
  }
}

RC_GTEST_PROP(EngineProperty, NoBlockExceedsRaw, ()) {
  const Trial trial = any_trial(kAllFormats, 8, 8);
  SurfaceEngine engine(trial.schemes, model(trial, false));
  FrameStatistics statistics;
  const uint64_t raw = 64 * traits(trial.format).pixel_bits;
  for (const Picture& picture : trial.frames) {
    process(engine, trial, picture, statistics);
    for (const SchemeStatistics& scheme : statistics.schemes) {
      RC_ASSERT(scheme.raw_bits == raw);
      RC_ASSERT(scheme.payload_bits <= raw);
    }
  }
}

RC_GTEST_PROP(EngineProperty, ASchemeAloneGivesWhatItGivesBesideOthers, ()) {
  const Trial trial = any_trial({PixelFormat::kRgba8}, 40, 24);
  SurfaceEngine together(trial.schemes, model(trial, false));
  std::vector<SurfaceEngine> alone;
  for (const SchemeSpec& scheme : trial.schemes)
    alone.emplace_back(std::vector<SchemeSpec>{scheme}, model(trial, false));
  FrameStatistics all, one;
  for (const Picture& picture : trial.frames) {
    process(together, trial, picture, all);
    for (size_t i = 0; i < alone.size(); ++i) {
      process(alone[i], trial, picture, one);
      RC_LOG() << trial.schemes[i].text << "\n";
      RC_ASSERT(one.schemes.size() == 1u);
      RC_ASSERT(one.schemes[0].payload_bits == all.schemes[i].payload_bits);
      RC_ASSERT(one.schemes[0].bursts == all.schemes[i].bursts);
      RC_ASSERT(one.schemes[0].csb_bits == all.schemes[i].csb_bits);
      RC_ASSERT(one.schemes[0].palette_bits == all.schemes[i].palette_bits);
      RC_ASSERT(one.schemes[0].extra_bits == all.schemes[i].extra_bits);
    }
  }
}

}  // namespace
