// Run options: ranges, checks, and the round trip through the environment.
#include "tilepress/run_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace tilepress {
namespace {

FrameSet frames(const char* text) {
  std::string error;
  auto set = FrameSet::parse(text, error);
  EXPECT_TRUE(set) << text << ": " << error;
  return set.value_or(FrameSet{});
}

std::string frames_error(const char* text) {
  std::string error;
  EXPECT_FALSE(FrameSet::parse(text, error)) << text;
  return error;
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
  std::string error;
  EXPECT_FALSE(set_run_option(options, name, value, error)) << name << " " << value;
  return error;
}

TEST(RunOptions, NameTheOptionAndTheValueThatIsOutOfRange) {
  EXPECT_EQ(option_error("tile", "12"), "tile 12: not a multiple of 8");
  EXPECT_EQ(option_error("tile", "0"), "tile 0: not in 8..4096");
  EXPECT_EQ(option_error("tile", "4104"), "tile 4104: not in 8..4096");
  EXPECT_EQ(option_error("tile", "32x"), "tile 32x: not a whole number");
  EXPECT_EQ(option_error("tile", ""), "tile '': not a whole number");
  EXPECT_EQ(option_error("burst", "8"), "burst 8: not in 16..2048");
  EXPECT_EQ(option_error("burst", "100"), "burst 100: not a power of two");
  EXPECT_EQ(option_error("burst", "99999999999999999999"), "burst 99999999999999999999: not in 16..2048");
  EXPECT_EQ(option_error("every", "0"), "every 0: not in 1..4294967295");
  EXPECT_EQ(option_error("every", "-1"), "every -1: not a whole number");
  EXPECT_EQ(option_error("verify", "maybe"), "verify maybe: neither 1 nor 0");
  EXPECT_EQ(option_error("on-full", "wait"), "on-full wait: neither block nor drop");
  EXPECT_EQ(option_error("queue", "0"), "queue 0: not in 1..64");
  EXPECT_EQ(option_error("readback", "pbo"), "readback pbo: not one of auto, sync, async, in-context");
  EXPECT_EQ(option_error("output", ""), "output '': no folder named");
  EXPECT_EQ(option_error("scheme", " "), "scheme  : no scheme named");
  EXPECT_EQ(option_error("frob", "1"), "frob: unknown option");
}

TEST(RunOptions, NameTheOneSchemeOfAListThatIsUnknown) {
  EXPECT_THAT(option_error("scheme", "dcp zip vdcp"),
              ::testing::StartsWith("scheme zip: unknown scheme 'zip'"));
}

TEST(RunOptions, ALineOfErrorLeavesTheOptionAsItWas) {
  RunOptions options;
  std::string error;
  ASSERT_FALSE(set_run_option(options, "scheme", "dcp zip", error));
  EXPECT_EQ(options.schemes.size(), 7u);
}

TEST(RunOptions, DropASchemeThatIsRepeated) {
  RunOptions options;
  std::string error;
  ASSERT_TRUE(set_run_option(options, "scheme", "vdcp ras vdcp vdcp:fvc=128", error)) << error;
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
  std::string error;
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
  for (const auto& [name, value] : values) ASSERT_TRUE(set_run_option(options, name, value, error)) << error;

  set(to_environment(options));
  RunOptions back;
  ASSERT_TRUE(from_environment(back, error)) << error;
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
  std::string error;
  ASSERT_TRUE(from_environment(back, error)) << error;
  EXPECT_TRUE(back.frames.all());
  EXPECT_EQ(back.every, 1u);
  EXPECT_EQ(back.log_file, "");
  EXPECT_EQ(back.schemes.size(), 7u);
}

TEST_F(RunEnvironment, NamesTheVariableAtFault) {
  set({{"TILEPRESS_FRAMES", "9-3"}});
  RunOptions back;
  std::string error;
  EXPECT_FALSE(from_environment(back, error));
  EXPECT_EQ(error, "TILEPRESS_FRAMES=9-3: reversed range 9-3");
}

}  // namespace
}  // namespace tilepress
