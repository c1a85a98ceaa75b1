// Frequent Values Collector: one test per rule.
#include "dcp/fvc.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

using namespace tilepress;

namespace {

constexpr uint32_t A = 0x10, B = 0x21, C = 0x32, D = 0x43, E = 0x54;

FvcConfig config(uint32_t entries, FvcPolicy policy, uint32_t ways = 0) {
  FvcConfig result;
  result.entries = entries;
  result.policy = policy;
  result.ways = ways;
  return result;
}

Fvc fed(const FvcConfig& fvc_config, const std::vector<uint32_t>& colors) {
  Fvc fvc(fvc_config, traits(PixelFormat::kRgba8));
  for (const uint32_t color : colors) fvc.see_run(color, 1);
  return fvc;
}

void expect_slot(const Fvc& fvc, uint32_t slot, uint32_t color, uint32_t count) {
  EXPECT_TRUE(fvc.valid(slot)) << "slot " << slot;
  EXPECT_EQ(fvc.color(slot), color) << "slot " << slot;
  EXPECT_EQ(fvc.count(slot), count) << "slot " << slot;
}

}  // namespace

TEST(Fvc, AHitAddsOneAndAMissTakesTheFirstEmptySlot) {
  const Fvc fvc = fed(config(4, FvcPolicy::kLfc), {A, A, B, A, B});
  expect_slot(fvc, 0, A, 3);
  expect_slot(fvc, 1, B, 2);
  EXPECT_FALSE(fvc.valid(2));
  EXPECT_EQ(fvc.samples(), 5u);
  EXPECT_EQ(fvc.held(), 5u);
  EXPECT_EQ(fvc.coverage(), 1.0);
}

TEST(Fvc, LfcEvictsTheSmallestCountAndStartsAtOne) {
  const Fvc fvc = fed(config(2, FvcPolicy::kLfc), {A, A, B, C});
  expect_slot(fvc, 0, A, 2);
  expect_slot(fvc, 1, C, 1);
  EXPECT_EQ(fvc.coverage(), 3.0 / 4);  // what B had counted is lost
}

TEST(Fvc, LfcTakesTheLowestSlotAmongEquals) {
  const Fvc fvc = fed(config(4, FvcPolicy::kLfc), {A, A, B, C, D, E});
  expect_slot(fvc, 1, E, 1);  // B, C and D have one each
  expect_slot(fvc, 2, C, 1);
}

TEST(Fvc, SecondLfcEvictsTheOneAfterTheSmallest) {
  const Fvc fvc = fed(config(4, FvcPolicy::k2Lfc), {A, A, A, B, C, C, D, D, D, D, E});
  expect_slot(fvc, 0, A, 3);
  expect_slot(fvc, 1, B, 1);  // the smallest stays
  expect_slot(fvc, 2, E, 1);
}

TEST(Fvc, SecondLfcBreaksTiesByLowestSlotOnceTheSmallestIsTakenAway) {
  // All equal: slot 0 is the smallest, slot 1 comes next.
  expect_slot(fed(config(4, FvcPolicy::k2Lfc), {A, B, C, D, E}), 1, E, 1);
  // The smallest is slot 2; of the rest slot 0 is the lowest.
  expect_slot(fed(config(4, FvcPolicy::k2Lfc), {A, A, B, B, C, D, D, E}), 0, E, 1);
}

TEST(Fvc, SecondLfcWithOneWayEvictsThatWay) {
  // Sets = 2; A (0x10) and C (0x32) are even: set 0.
  const Fvc fvc = fed(config(2, FvcPolicy::k2Lfc, 1), {A, A, B, C});
  expect_slot(fvc, 0, C, 1);
  expect_slot(fvc, 1, B, 1);
}

TEST(Fvc, LruEvictsTheLeastRecentlyHitOrInserted) {
  expect_slot(fed(config(2, FvcPolicy::kLru), {A, B, A, C}), 1, C, 1);  // B was used before A
  expect_slot(fed(config(2, FvcPolicy::kLru), {A, B, C}), 0, C, 1);     // A was inserted before B
}

TEST(Fvc, RandomEvictsByXorshiftStartedAnewAtEachReset) {
  // xorshift32 from 0x9E3779B9: 0x510C4619, 0xE02E553E, 0x7BB98F3A, 0x0183A8B5; modulo 4: 1, 2, 2, 1.
  Fvc fvc = fed(config(4, FvcPolicy::kRandom), {A, B, C, D});
  fvc.see_run(0x100, 1);
  expect_slot(fvc, 1, 0x100, 1);
  fvc.see_run(0x100, 1);  // a hit: no step
  fvc.see_run(0x200, 1);
  expect_slot(fvc, 2, 0x200, 1);
  fvc.see_run(0x300, 1);
  expect_slot(fvc, 2, 0x300, 1);
  fvc.see_run(0x400, 1);
  expect_slot(fvc, 1, 0x400, 1);
  fvc.reset();
  for (const uint32_t color : {A, B, C, D, E}) fvc.see_run(color, 1);
  expect_slot(fvc, 1, E, 1);
}

TEST(Fvc, RandomStaysInItsSet) {
  // Two sets of two ways; even colours in set 0. The first step, 0x510C4619, is odd: way 1.
  const Fvc fvc = fed(config(4, FvcPolicy::kRandom, 2), {0x02, 0x04, 0x06});
  expect_slot(fvc, 0, 0x02, 1);
  expect_slot(fvc, 1, 0x06, 1);
  EXPECT_FALSE(fvc.valid(2));
}

TEST(Fvc, TheSetIsTheExclusiveOrOfTheChannels) {
  // 8 entries of 2 ways: 4 sets. R=1, G=2, B=4, A=9: 1^2^4^9 = 14, 14 mod 4 = 2, slots 4 and 5.
  const Fvc fvc = fed(config(8, FvcPolicy::kLfc, 2), {0x09040201, 0x00000006});
  expect_slot(fvc, 4, 0x09040201, 1);
  expect_slot(fvc, 5, 0x00000006, 1);
}

TEST(Fvc, TheSetOfA565PixelComesFromItsOwnChannels) {
  Fvc fvc(config(8, FvcPolicy::kLfc, 1), traits(PixelFormat::kRgb565));
  fvc.see_run(3u << 11 | 5u << 5 | 1u, 1);  // 3^5^1 = 7
  expect_slot(fvc, 7, 3u << 11 | 5u << 5 | 1u, 1);
}

TEST(Fvc, SamplingTakesPixels0AndEveryNth) {
  FvcConfig sampled = config(4, FvcPolicy::kLfc);
  sampled.sample = 3;
  const Fvc fvc = fed(sampled, {A, B, B, C, B, B, A});
  EXPECT_EQ(fvc.samples(), 3u);
  expect_slot(fvc, 0, A, 2);
  expect_slot(fvc, 1, C, 1);
}

TEST(Fvc, ResetEmptiesItAndSamplesFromPixel0Again) {
  FvcConfig sampled = config(4, FvcPolicy::kLfc);
  sampled.sample = 3;
  Fvc fvc = fed(sampled, {A, B});
  fvc.reset();
  EXPECT_EQ(fvc.samples(), 0u);
  EXPECT_EQ(fvc.coverage(), 0.0);
  EXPECT_FALSE(fvc.valid(0));
  fvc.see_run(C, 1);
  expect_slot(fvc, 0, C, 1);
}
