// Run options: ranges, checks, and the round trip through the environment.
#include "tilepress/run_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "tilepress/run_option_table.h"

namespace tilepress {
namespace {

FrameSet frames(const char* text) {
  const auto set = FrameSet::parse(text);
  EXPECT_TRUE(set) << text << ": " << set.error().text;
  return set ? *set : FrameSet{};
}

std::string frames_error(const char* text) {
  const auto set = FrameSet::parse(text);
  EXPECT_FALSE(set) << text;
  return set ? "" : set.error().text;
}

TEST(FrameSet, HoldsBothEndsOfARange) {
  const FrameSet set = frames("3-5,9");
  EXPECT_FALSE(set.contains(2));
  EXPECT_TRUE(set.contains(3));
  EXPECT_TRUE(set.contains(5));
  EXPECT_FALSE(set.contains(6));
  EXPECT_TRUE(set.contains(9));
  EXPECT_FALSE(set.contains(10));
  EXPECT_EQ(set.last(), 9u);
}

TEST(FrameSet, WithoutRangesHoldsEveryFrame) {
  EXPECT_TRUE(FrameSet{}.all());
  EXPECT_TRUE(FrameSet{}.contains(123456789));
  EXPECT_EQ(FrameSet{}.last(), std::nullopt);
}

TEST(FrameSet, MergesRangesThatTouchOrOverlap) {
  EXPECT_EQ(frames("5-9,0-2,3,8-12").text(), "0-3,5-12");
  EXPECT_EQ(frames("0-18446744073709551615,7").text(), "0-18446744073709551615");
}

TEST(FrameSet, NamesTheRangeThatIsReversed) {
  EXPECT_EQ(frames_error("0-4,9-3"), "reversed range 9-3");
}

TEST(FrameSet, RefusesWhatIsNoRange) {
  for (const char* text : {"", ",", "1,,2", "1,"}) EXPECT_EQ(frames_error(text), "empty range") << text;
  for (const char* text : {"x", "-", "-3", "3-", "1-2-3", "1.5", " 1", "+1", "18446744073709551616"})
    EXPECT_THAT(frames_error(text), ::testing::HasSubstr("is not a frame or a range of frames")) << text;
}

std::string option_error(const char* name, const char* value) {
  RunOptions options;
  const auto set = set_run_option(options, name, value);
  EXPECT_FALSE(set) << name << " " << value;
  return set ? "" : set.error().text;
}

TEST(RunOptions, NameTheOptionAndTheValueThatIsOutOfRange) {
  EXPECT_EQ(option_error("tile", "12"), "tile 12: must be a multiple of 8 in 8..4096");
  EXPECT_EQ(option_error("tile", "0"), "tile 0: must be a multiple of 8 in 8..4096");
  EXPECT_EQ(option_error("tile", "4104"), "tile 4104: must be a multiple of 8 in 8..4096");
  EXPECT_EQ(option_error("tile", "32x"), "tile 32x: must be a multiple of 8 in 8..4096");
  EXPECT_EQ(option_error("tile", ""), "tile '': must be a multiple of 8 in 8..4096");
  EXPECT_EQ(option_error("burst", "8"), "burst 8: must be a power of two in 16..2048");
  EXPECT_EQ(option_error("burst", "100"), "burst 100: must be a power of two in 16..2048");
  EXPECT_EQ(option_error("burst", "99999999999999999999"),
            "burst 99999999999999999999: must be a power of two in 16..2048");
  EXPECT_EQ(option_error("every", "0"), "every 0: must be a number in 1..4294967295");
  EXPECT_EQ(option_error("every", "-1"), "every -1: must be a number in 1..4294967295");
  EXPECT_EQ(option_error("verify", "maybe"), "verify maybe: must be 1 or 0");
  EXPECT_EQ(option_error("on-full", "wait"), "on-full wait: must be block or drop");
  EXPECT_EQ(option_error("queue", "0"), "queue 0: must be a number in 1..64");
  EXPECT_EQ(option_error("readback", "pbo"), "readback pbo: must be auto, sync, async or in-context");
  EXPECT_EQ(option_error("output", ""), "output '': must be a folder");
  EXPECT_EQ(option_error("scheme", " "), "scheme  : must be a scheme; see tilepress schemes");
  EXPECT_EQ(option_error("frob", "1"), "frob: unknown option");
}

TEST(RunOptions, NameTheOneSchemeOfAListThatIsUnknown) {
  EXPECT_THAT(option_error("scheme", "dcp zip vdcp"),
              ::testing::StartsWith("scheme zip: unknown scheme 'zip'"));
}

TEST(RunOptions, ALineOfErrorLeavesTheOptionAsItWas) {
  RunOptions options;
  ASSERT_FALSE(set_run_option(options, "scheme", "dcp zip"));
  EXPECT_EQ(options.schemes.size(), 7u);
}

TEST(RunOptions, DropASchemeThatIsRepeated) {
  RunOptions options;
  ASSERT_TRUE(set_run_option(options, "scheme", "vdcp ras vdcp vdcp:fvc=128"));
  ASSERT_EQ(options.schemes.size(), 3u);
  EXPECT_EQ(options.schemes[0].text, "vdcp");
  EXPECT_EQ(options.schemes[1].text, "ras");
  EXPECT_EQ(options.schemes[2].text, "vdcp:fvc=128");
}

TEST(RunOptions, TakeEveryNthFrameOfTheRanges) {
  RunOptions options;
  options.frames = frames("4-10");
  options.every = 3;
  std::vector<uint64_t> taken;
  for (uint64_t frame = 0; frame < 20; ++frame)
    if (options.takes(frame)) taken.push_back(frame);
  EXPECT_THAT(taken, ::testing::ElementsAre(6, 9));
}

/// Values that a row takes, and values that it refuses. Every row has both, unless it takes any text.
struct Samples {
  std::vector<const char*> good, bad;
};

const std::map<std::string_view, Samples>& samples() {
  static const std::map<std::string_view, Samples> kSamples = {
      {"log-level", {{"trace", "off"}, {"loud", ""}}},
      {"log-file", {{"/tmp/l"}, {}}},
      {"output", {{"/a b"}, {""}}},
      {"plugin", {{""}, {"/no/such.so", "/", ":/no/such.so"}}},
      {"scheme", {{"dcp", "vdcp:fvc=128 ras"}, {"", "zip", "dcp zip", "vdcp:fvc=999999"}}},
      {"tile", {{"8", "4096"}, {"0", "12", "4104", "x"}}},
      {"burst", {{"16", "2048"}, {"8", "100", "4096", ""}}},
      {"dram", {{"paper", "lpddr3", "lpddr4", "lpddr5"}, {"ddr4", ""}}},
      {"toggles", {{"16", "32"}, {"8", "64", "x"}}},
      {"verify", {{"0", "1"}, {"2", ""}}},
      {"frames", {{"0-9,20"}, {"", "9-3", "x"}}},
      {"every", {{"1", "4294967295"}, {"0", "4294967296", "-1"}}},
      {"heatmaps", {{"every:1"}, {"every:0", "every:", "10"}}},
      {"dump-frames", {{"every:30"}, {"every:x", "all"}}},
      {"on-full", {{"block", "drop"}, {"wait", ""}}},
      {"queue", {{"1", "64"}, {"0", "65"}}},
      {"block-log", {{"", "vdcp:fvc=16"}, {}}},
      {"block-log-data", {{"1", "0"}, {"2", "maybe"}}},
      {"readback", {{"auto", "sync", "async", "in-context"}, {"pbo", ""}}},
      {"trigger", {{"finish", "finish,flush,readpixels"}, {"swap", "finish,", ","}}},
      {"targets", {{"presented", "all"}, {"none", ""}}},
  };
  return kSamples;
}

TEST(RunOptionTable, EachOptionPrintsWhatItRead) {
  ASSERT_EQ(run_option_table().size(), samples().size());
  for (const RunOption& option : run_option_table())
    for (const char* value : samples().at(option.name).good) {
      RunOptions options;
      const auto set = set_run_option(options, option.name, value);
      EXPECT_TRUE(set) << set.error().text;
      EXPECT_EQ(option.text.print(options), value) << option.name;
    }
}

TEST(RunOptionTable, EachOptionRefusesOtherValuesAndStaysAsItWas) {
  for (const RunOption& option : run_option_table())
    for (const char* value : samples().at(option.name).bad) {
      RunOptions options;
      const auto set = set_run_option(options, option.name, value);
      ASSERT_FALSE(set) << option.name << " " << value;
      EXPECT_EQ(set.error().kind, ErrorKind::kBadValue);
      EXPECT_THAT(set.error().text, ::testing::StartsWith(std::string(option.name) + " "));
      EXPECT_EQ(to_environment(options), to_environment(RunOptions{})) << option.name << " " << value;
    }
}

TEST(RunOptions, ADramPresetSetsTheBurst) {
  RunOptions options;
  ASSERT_TRUE(set_run_option(options, "dram", "lpddr3"));  // x32, burst length 8
  EXPECT_EQ(options.model.burst_bits, 32u * 8);
  ASSERT_TRUE(set_run_option(options, "dram", "lpddr4"));  // x16, burst length 16
  EXPECT_EQ(options.model.burst_bits, 16u * 16);
  ASSERT_TRUE(set_run_option(options, "dram", "paper"));
  EXPECT_EQ(options.model.burst_bits, 128u);
}

TEST(RunOptions, AToggleBusIsNoWiderThanABurst) {
  RunOptions options;
  ASSERT_TRUE(set_run_option(options, "burst", "16"));
  EXPECT_TRUE(set_run_option(options, "toggles", "16"));
  const auto set = set_run_option(options, "toggles", "32");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().text, "toggles 32: must not be wider than --burst");
}

TEST(RunOptionTable, NamesVariablesAndFlagsAreUnique) {
  std::set<std::string_view> seen;
  for (const RunOption& option : run_option_table()) {
    EXPECT_EQ(find_run_option(option.name), &option);
    EXPECT_TRUE(seen.insert(option.name).second) << option.name;
    EXPECT_TRUE(seen.insert(option.variable).second) << option.variable;
    EXPECT_THAT(option.variable, ::testing::StartsWith("TILEPRESS_"));
    if (!option.flags.empty()) {
      EXPECT_THAT(option.flags, ::testing::EndsWith("--" + std::string(option.name)));
    }
    EXPECT_EQ(option.flags.empty(), option.help.empty()) << option.name;
    EXPECT_EQ(option.json.form == JsonForm::kAbsent, option.json.key.empty()) << option.name;
  }
  EXPECT_EQ(find_run_option("frob"), nullptr);
}

TEST(RunOptionTable, TheHelpGivesTheDefault) {
  const std::string start = "(default: ";
  for (const RunOption& option : run_option_table()) {
    const size_t place = option.help.find(start);
    const std::string value = option.text.print(RunOptions{});
    if (place == std::string_view::npos || value.empty() || option.name == "scheme") continue;
    EXPECT_THAT(option.help.substr(place + start.size()), ::testing::StartsWith(value)) << option.name;
  }
}

TEST(RunOptionTable, OptionsThatChangeRowsMakeTheFingerprint) {
  RunOptions options;
  ASSERT_TRUE(set_run_option(options, "scheme", "vdcp ras"));
  EXPECT_EQ(rows_fingerprint(options), "vdcp ras tile=32 burst=128 verify=0 frames= every=1");
  ASSERT_TRUE(set_run_option(options, "trigger", "flush"));
  ASSERT_TRUE(set_run_option(options, "targets", "all"));
  ASSERT_TRUE(set_run_option(options, "queue", "9"));
  EXPECT_EQ(rows_fingerprint(options),
            "vdcp ras tile=32 burst=128 verify=0 frames= every=1 trigger=flush targets=all");
}

class RunEnvironment : public ::testing::Test {
 protected:
  void set(const std::map<std::string, std::string>& variables) {
    for (const auto& [name, value] : variables) {
      setenv(name.c_str(), value.c_str(), 1);
      names_.push_back(name);
    }
  }
  void TearDown() override {
    for (const std::string& name : names_) unsetenv(name.c_str());
  }
  std::vector<std::string> names_;
};

TEST_F(RunEnvironment, CarriesEveryOption) {
  RunOptions options;
  const std::map<std::string, std::string> values = {{"scheme", "vdcp:fvc=128,policy=2lfc ras:ycocg=1"},
                                                     {"tile", "64"},
                                                     {"burst", "256"},
                                                     {"frames", "0-9,20"},
                                                     {"every", "5"},
                                                     {"verify", "1"},
                                                     {"on-full", "drop"},
                                                     {"queue", "7"},
                                                     {"readback", "async"},
                                                     {"output", "/a b"},
                                                     {"log-level", "debug"},
                                                     {"log-file", "/tmp/l"}};
  for (const auto& [name, value] : values) ASSERT_TRUE(set_run_option(options, name, value)) << name;

  set(to_environment(options));
  RunOptions back;
  ASSERT_TRUE(from_environment(back));
  EXPECT_EQ(to_environment(back), to_environment(options));
  EXPECT_EQ(back.schemes[0].number("fvc"), 128u);
  EXPECT_EQ(back.schemes[1].number("ycocg"), 1u);
  EXPECT_EQ(back.model.tile_side, 64u);
  EXPECT_EQ(back.model.burst_bits, 256u);
  EXPECT_TRUE(back.model.verify);
  EXPECT_EQ(back.frames.text(), "0-9,20");
  EXPECT_EQ(back.every, 5u);
  EXPECT_EQ(back.on_full, OnFull::kDrop);
  EXPECT_EQ(back.queue_frames, 7u);
  EXPECT_EQ(back.readback, Readback::kAsync);
  EXPECT_EQ(back.output, "/a b");
}

TEST_F(RunEnvironment, OfTheDefaultsOverridesWhatWasInherited) {
  set({{"TILEPRESS_FRAMES", "3-4"}, {"TILEPRESS_EVERY", "7"}, {"TILEPRESS_LOG_FILE", "/tmp/l"}});
  set(to_environment(RunOptions{}));
  RunOptions back;
  ASSERT_TRUE(from_environment(back));
  EXPECT_TRUE(back.frames.all());
  EXPECT_EQ(back.every, 1u);
  EXPECT_EQ(back.log_file, "");
  EXPECT_EQ(back.schemes.size(), 7u);
}

TEST_F(RunEnvironment, NamesTheVariableAtFault) {
  set({{"TILEPRESS_FRAMES", "9-3"}});
  RunOptions back;
  const auto read = from_environment(back);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().text, "TILEPRESS_FRAMES=9-3: reversed range 9-3");
}

}  // namespace
}  // namespace tilepress
