// Readback probe: what it decides, on costs that are made up.
#include "interposer/engine/read_policy.h"

#include <gtest/gtest.h>

namespace tilepress {
namespace {

struct Costs {
  uint64_t sync_ns, buffered_ns, async_ns;
};

constexpr uint64_t kMicrosecond = 1000;

/// Feeds a probe what reads would cost until it has settled, and a few frames on. The ways it took.
std::vector<ReadWay> ways_taken(ReadbackProbe& probe, const Costs& costs) {
  std::vector<ReadWay> ways;
  for (int frame = 0; frame < 40; ++frame) {
    const ReadWay way = probe.next();
    ways.push_back(way);
    // Every fourth frame something else takes a long time: medians do not mind.
    const uint64_t hiccup = frame % 4 == 3 ? 50'000 * kMicrosecond : 0;
    probe.note(way, (way == ReadWay::kAsync ? costs.async_ns : costs.sync_ns) + hiccup,
               way == ReadWay::kBoth ? costs.buffered_ns + hiccup : 0);
  }
  return ways;
}

ReadWay choice_for(const Costs& costs) {
  ReadbackProbe probe;
  return ways_taken(probe, costs).back();
}

TEST(ReadbackProbe, ChoosesPixelBuffersWhereTheySaveTheThreadMostOfItsTime) {
  EXPECT_EQ(choice_for({3000 * kMicrosecond, 150 * kMicrosecond, 150 * kMicrosecond}), ReadWay::kAsync);
}

TEST(ReadbackProbe, StaysSynchronousWithoutAClearMargin) {
  // As on a software renderer: the read runs in the call either way.
  EXPECT_EQ(choice_for({200 * kMicrosecond, 190 * kMicrosecond, 190 * kMicrosecond}), ReadWay::kSync);
  // Not twice as cheap.
  EXPECT_EQ(choice_for({3000 * kMicrosecond, 1501 * kMicrosecond, 1501 * kMicrosecond}), ReadWay::kSync);
  EXPECT_EQ(choice_for({3000 * kMicrosecond, 1500 * kMicrosecond, 1500 * kMicrosecond}), ReadWay::kAsync);
  // Twice as cheap, but of next to nothing.
  EXPECT_EQ(choice_for({109 * kMicrosecond, 10 * kMicrosecond, 10 * kMicrosecond}), ReadWay::kSync);
  EXPECT_EQ(choice_for({110 * kMicrosecond, 10 * kMicrosecond, 10 * kMicrosecond}), ReadWay::kAsync);
}

TEST(ReadbackProbe, GoesBackWhereAsynchronousReadsDoNotKeepTheirPromise) {
  ReadbackProbe probe;
  const std::vector<ReadWay> ways =
      ways_taken(probe, {3000 * kMicrosecond, 150 * kMicrosecond, 2900 * kMicrosecond});
  EXPECT_EQ(std::count(ways.begin(), ways.end(), ReadWay::kAsync), 7);
  EXPECT_EQ(ways.back(), ReadWay::kSync);
  EXPECT_EQ(probe.text(),
            "synchronous reads 3.000 ms, into pixel buffers 0.150 ms, on trial 2.900 ms: synchronous");
}

TEST(ReadbackProbe, ReadsEveryFrameSynchronouslyWhileItDecides) {
  ReadbackProbe probe;
  const std::vector<ReadWay> ways = ways_taken(probe, {3000 * kMicrosecond, 2000 * kMicrosecond, 0});
  // Four to warm up and six timed; one to make the buffer and six timed.
  for (size_t i = 0; i < ways.size(); ++i)
    EXPECT_EQ(ways[i], i >= 10 && i < 17 ? ReadWay::kBoth : ReadWay::kSync) << i;
  EXPECT_EQ(probe.text(), "synchronous reads 3.000 ms, into pixel buffers 2.000 ms: synchronous");
}

TEST(ReadbackProbe, SettlesAtOnceWherePixelBuffersCannotBeUsed) {
  ReadbackProbe probe;
  const std::vector<ReadWay> ways = ways_taken(probe, {3000 * kMicrosecond, 0, 0});
  EXPECT_EQ(std::count(ways.begin(), ways.end(), ReadWay::kSync), 39);
  EXPECT_EQ(probe.text(), "pixel buffers cannot be used: synchronous reads");
}

TEST(ReadbackProbe, SettlesWhereTheSourceReadsInAnotherWayThanItWasAsked) {
  ReadbackProbe in_context;
  EXPECT_TRUE(in_context.note(ReadWay::kInContext, 1, 0));
  EXPECT_EQ(in_context.next(), ReadWay::kSync);
}

CapturedFrame& frame_that_cost(CapturedFrame& frame, ReadWay way) {
  frame.way = way;
  frame.bind_ns = 10 * kMicrosecond;
  frame.read_ns = way == ReadWay::kAsync ? 0 : 3000 * kMicrosecond;
  frame.buffered_ns = way == ReadWay::kBoth ? 1 : 0;
  return frame;
}

/// Presents `frames` frames of a window. Returns how many lines the policy had for the log, and the last way.
std::pair<int, ReadWay> present(ReadPolicy& policy, uint32_t window, uint64_t pixels, int frames) {
  const ReadCase read{window, pixels, true, false, false};
  CapturedFrame frame;
  int told = 0;
  ReadWay way = ReadWay::kSync;
  for (int i = 0; i < frames; ++i) {
    way = policy.way(read);
    if (!policy.note(read, frame_that_cost(frame, way)).empty()) ++told;
  }
  return {told, way};
}

TEST(ReadPolicy, ChoosesForEachWindowAndAgainWhereItsSizeIsAnother) {
  ReadPolicy choices(Readback::kAuto);
  EXPECT_EQ(present(choices, 1, 1000, 40), std::make_pair(1, ReadWay::kAsync));
  EXPECT_EQ(present(choices, 2, 1000, 5), std::make_pair(0, ReadWay::kSync));  // not decided yet
  EXPECT_EQ(present(choices, 1, 2000, 5), std::make_pair(0, ReadWay::kAsync));
  EXPECT_EQ(present(choices, 1, 500, 5), std::make_pair(0, ReadWay::kAsync));
  EXPECT_EQ(present(choices, 1, 2001, 40), std::make_pair(1, ReadWay::kAsync));
  choices.forget(1);
  EXPECT_EQ(present(choices, 1, 2001, 5), std::make_pair(0, ReadWay::kSync));
}

TEST(ReadPolicy, FollowsTheUserWhereThereIsAWish) {
  ReadPolicy sync(Readback::kSync), async(Readback::kAsync), in_context(Readback::kInContext);
  EXPECT_EQ(present(sync, 1, 1000, 40), std::make_pair(0, ReadWay::kSync));
  EXPECT_EQ(present(async, 1, 1000, 1), std::make_pair(0, ReadWay::kAsync));
  EXPECT_EQ(present(in_context, 1, 1000, 40), std::make_pair(0, ReadWay::kSync));
}

TEST(ReadPolicy, ReadsASoftwareWindowInPlaceUnlessItsPixelsAreAskedForLate) {
  ReadPolicy automatic(Readback::kAuto), sync(Readback::kSync), async(Readback::kAsync);
  const ReadCase known{1, 1000, true, true, false}, first{1, 1000, true, true, true},
      trigger{1, 1000, false, true, false};
  EXPECT_EQ(automatic.way(known), ReadWay::kInContext);
  EXPECT_EQ(sync.way(known), ReadWay::kInContext);
  EXPECT_EQ(async.way(known), ReadWay::kAsync);
  EXPECT_EQ(async.way(first), ReadWay::kInContext);    // the window may just be resized
  EXPECT_EQ(async.way(trigger), ReadWay::kInContext);  // a trigger needs the pixels in the call
}

TEST(ReadPolicy, HasNothingToProbeWhereAFrameIsReadInPlaceOrMayNotBeLate) {
  ReadPolicy policy(Readback::kAuto);
  CapturedFrame frame;
  for (const ReadCase& read : {ReadCase{1, 1000, true, true, false}, ReadCase{1, 1000, false, false, false}})
    for (int i = 0; i < 40; ++i) {
      const ReadWay way = policy.way(read);
      EXPECT_EQ(way, read.software_window ? ReadWay::kInContext : ReadWay::kSync);
      EXPECT_EQ(policy.note(read, frame_that_cost(frame, way)), "");
    }
  EXPECT_EQ(present(policy, 1, 1000, 40), std::make_pair(1, ReadWay::kAsync));
}

}  // namespace
}  // namespace tilepress
