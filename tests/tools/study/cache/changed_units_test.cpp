// Tests of changed units, row differences and LZ4 blocks.
#include "study/cache/changed_units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "study/cache/file_bytes.h"
#include "study/cache/lz4_blocks.h"
#include "study/cache/row_differences.h"

namespace tilepress {
namespace {

using Bytes = std::vector<std::byte>;

Bytes random_bytes(size_t count, unsigned seed) {
  std::minstd_rand random(seed);
  Bytes bytes(count);
  for (std::byte& each : bytes) each = static_cast<std::byte>(random() >> 8);
  return bytes;
}

TEST(ChangedUnits, AreMarkedByTheirFirstAndLastBytes) {
  // 130 bytes are two whole units and one of 2 bytes.
  const Bytes before(130, std::byte{1});
  Bytes frame = before;
  std::string map;
  EXPECT_EQ(mark_changed_units(frame, before, map), 0u);
  EXPECT_EQ(map, std::string(1, '\0'));
  frame[63] = std::byte{2};
  frame[128] = std::byte{2};
  EXPECT_EQ(mark_changed_units(frame, before, map), 64u + 2u);
  EXPECT_EQ(map, std::string(1, '\x05'));
  EXPECT_EQ(changed_bytes(bytes_of(map), frame.size()), 66u);
}

TEST(ChangedUnits, RunsAreThoseOfTheMap) {
  const size_t size = 64 * 21 + 5;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Bytes before = random_bytes(size, 1);
    Bytes frame = before;
    std::minstd_rand random(seed);
    std::vector<bool> changed(22, false);
    for (size_t unit = 0; unit < 22; ++unit) {
      changed[unit] = random() % (1 + seed % 5) == 0;
      if (changed[unit]) frame[unit * 64] ^= std::byte{1};
    }
    std::string map;
    const size_t bytes = mark_changed_units(frame, before, map);
    std::vector<bool> seen(22, false);
    size_t sum = 0, last_end = 0;
    ChangedRuns runs(bytes_of(map), size);
    for (ChangedRun run; runs.next(run);) {
      EXPECT_EQ(run.begin % 64, 0u);
      EXPECT_TRUE(run.begin > last_end || last_end == 0) << "two runs that touch";
      for (size_t unit = run.begin / 64; unit * 64 < run.end; ++unit) seen[unit] = true;
      sum += run.bytes();
      last_end = run.end;
    }
    EXPECT_EQ(seen, changed);
    EXPECT_EQ(sum, bytes);
    EXPECT_EQ(changed_bytes(bytes_of(map), size), bytes);
  }
}

TEST(ChangedUnits, NoMapIsTheWholeFrame) {
  ChangedRuns runs({}, 100);
  ChangedRun run;
  ASSERT_TRUE(runs.next(run));
  EXPECT_EQ(run.begin, 0u);
  EXPECT_EQ(run.end, 100u);
  EXPECT_FALSE(runs.next(run));
}

TEST(ChangedUnits, BitsPastTheLastUnitAreFound) {
  // 130 bytes have 3 units: bits 3 to 7 are past them.
  EXPECT_FALSE(has_stray_bits(bytes_of("\x07"), 130));
  EXPECT_TRUE(has_stray_bits(bytes_of("\x08"), 130));
  EXPECT_FALSE(has_stray_bits(bytes_of("\xFF"), 512));
}

TEST(RowDifferences, ComeBackForAnyPitchAndRange) {
  for (const size_t pitch : {1, 2, 15, 16, 17, 64, 200}) {
    const Bytes frame = random_bytes(1000, static_cast<unsigned>(pitch));
    for (const size_t begin : {size_t{0}, size_t{64}, size_t{192}}) {
      for (const size_t end : {begin + 1, begin + 64, size_t{1000}}) {
        Bytes differences(end - begin), out(frame.begin(), frame.begin() + static_cast<ptrdiff_t>(begin));
        out.resize(frame.size());
        take_row_differences(frame.data(), pitch, begin, end, differences.data());
        if (end > pitch && begin <= pitch) {
          EXPECT_EQ(static_cast<int>(differences[pitch - begin]),
                    (static_cast<int>(frame[pitch]) - static_cast<int>(frame[0])) & 0xFF);
        }
        add_row_differences(differences.data(), pitch, begin, end, out.data());
        out.resize(end);
        EXPECT_EQ(out, Bytes(frame.begin(), frame.begin() + static_cast<ptrdiff_t>(end)));
      }
    }
  }
}

/// The bytes of all blocks; empty if a block is damaged or bytes are left.
Bytes unpacked(const std::string& packed, size_t size) {
  Bytes out, room(kLz4BlockBytes);
  Lz4Blocks blocks(bytes_of(packed));
  while (out.size() < size) {
    const auto block = blocks.next(std::span(room).first(std::min(kLz4BlockBytes, size - out.size())));
    if (block.empty()) return {};
    out.insert(out.end(), block.begin(), block.end());
  }
  return blocks.at_end() ? out : Bytes();
}

TEST(Lz4Blocks, StoreWhatHardlyGetsSmallerWithinTheBudget) {
  // Two blocks. The first one is noise in three of four parts, so that LZ4 takes a quarter away. The second
  // is zeros.
  Bytes bytes = random_bytes(kLz4BlockBytes / 4 * 3, 1);
  bytes.resize(2 * kLz4BlockBytes);
  std::string small, large;
  pack_lz4_blocks(bytes, 0, small);
  pack_lz4_blocks(bytes, bytes.size(), large);
  EXPECT_LT(small.size(), kLz4BlockBytes);
  EXPECT_GT(large.size(), kLz4BlockBytes);
  EXPECT_LT(large.size(), kLz4BlockBytes + 2000) << "the zeros are not stored";
  EXPECT_EQ(unpacked(small, bytes.size()), bytes);
  EXPECT_EQ(unpacked(large, bytes.size()), bytes);
  std::string tight;
  pack_lz4_blocks(bytes, large.size() - 1, tight);
  EXPECT_EQ(tight, small);
}

TEST(Lz4Blocks, NoiseIsStoredWhateverTheBudgetIs) {
  const Bytes bytes = random_bytes(kLz4BlockBytes + 5, 3);
  std::string packed;
  pack_lz4_blocks(bytes, 0, packed);
  EXPECT_EQ(packed.size(), bytes.size() + 8);
  EXPECT_EQ(unpacked(packed, bytes.size()), bytes);
  EXPECT_TRUE(unpacked(packed.substr(0, packed.size() - 1), bytes.size()).empty());
  EXPECT_TRUE(unpacked(packed, bytes.size() - 1).empty());
}

}  // namespace
}  // namespace tilepress
