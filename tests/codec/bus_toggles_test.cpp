// Bus toggles: derived numbers for the bus, and a plain reference for the order of a frame's writes.
#include "memory/bus_toggles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "memory/surface_samples.h"

namespace tilepress {
namespace {

TEST(MemoryBus, StartsAtZerosAndCountsTheWiresThatChange) {
  MemoryBus bus(16);
  bus.send(std::vector<uint8_t>{0x01, 0x00, 0x03, 0x80});  // 0 → 0001: 1, 0001 → 8003: 2
  EXPECT_EQ(bus.toggles(), 3u);
  MemoryBus wide(32);
  wide.send(std::vector<uint8_t>{0x01, 0x00, 0x03, 0x80});  // one beat: 1 + 2 + 1
  EXPECT_EQ(wide.toggles(), 4u);
}

TEST(MemoryBus, InvertsALaneWhereMoreThanFourWiresWouldChange) {
  MemoryBus bus(16);
  // Lane 0: 8 changes, so 00 goes out and the DBI wire rises: 1. Lane 1: 4 changes, not inverted: 4.
  bus.send(std::vector<uint8_t>{0xFF, 0x0F});
  EXPECT_EQ(bus.toggles(), 12u);
  EXPECT_EQ(bus.toggles_with_inversion(), 5u);
  bus.send(std::vector<uint8_t>{0xFF, 0x0F});  // the same again
  EXPECT_EQ(bus.toggles(), 12u);
  EXPECT_EQ(bus.toggles_with_inversion(), 5u);
  bus.send(std::vector<uint8_t>{0x00, 0x0F});  // lane 0 has 00 on its wires: only the DBI wire falls
  EXPECT_EQ(bus.toggles(), 20u);
  EXPECT_EQ(bus.toggles_with_inversion(), 6u);
}

/// Counts wire by wire.
std::pair<uint64_t, uint64_t> count_slowly(const std::vector<uint8_t>& bytes, uint32_t width_bits) {
  uint64_t plain = 0, inverted = 0;
  const uint32_t lanes = width_bits / 8;
  std::vector<int> before(width_bits), sent(width_bits), dbi(lanes);
  for (size_t beat = 0; beat < bytes.size(); beat += lanes)
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      int changes = 0;
      for (uint32_t wire = 0; wire < 8; ++wire) {
        const int bit = bytes[beat + lane] >> wire & 1;
        plain += before[8 * lane + wire] != bit;
        before[8 * lane + wire] = bit;
        changes += sent[8 * lane + wire] != bit;
      }
      const int invert = changes > 4;
      for (uint32_t wire = 0; wire < 8; ++wire) {
        const int bit = before[8 * lane + wire] ^ invert;
        inverted += sent[8 * lane + wire] != bit;
        sent[8 * lane + wire] = bit;
      }
      inverted += dbi[lane] != invert;
      dbi[lane] = invert;
    }
  return {plain, inverted};
}

std::vector<std::pair<uint32_t, uint32_t>> blocks_in_order(uint32_t width, uint32_t height, uint32_t tile) {
  std::vector<std::pair<uint32_t, uint32_t>> blocks;
  for (uint32_t by = 0; by < height; by += 8)
    for (uint32_t bx = 0; bx < width; bx += 8) blocks.push_back({bx / 8, by / 8});
  std::sort(blocks.begin(), blocks.end(), [&](const auto& a, const auto& b) {
    const uint32_t side = tile / 8;
    return std::tuple(a.second / side, a.first / side, a.second, a.first) <
           std::tuple(b.second / side, b.first / side, b.second, b.first);
  });
  return blocks;
}

void append_bursts(std::vector<uint8_t>& out, const uint8_t* from, size_t bytes, size_t burst_bytes) {
  out.insert(out.end(), from, from + bytes);
  while (out.size() % burst_bytes != 0) out.push_back(0);
}

TEST(BusToggles, AFrameTakesTheOrderOfTheTracesWrites) {
  const std::vector<SampleFrame> frames = {mixed_frame(52, 44, PixelFormat::kRgba8, 1),
                                           mixed_frame(52, 44, PixelFormat::kRgba8, 2)};
  for (const uint32_t width : {16u, 32u})
    for (const char* scheme : {"vdcp:fvc=16", "ras", "red", "huffdcp"}) {
      const ModelOptions options{.tile_side = 16, .burst_bits = 256, .toggle_bits = width};
      SchemeStatistics counted;
      const CompressedSurface surface = compress(scheme, frames, options, &counted);
      std::vector<uint8_t> written, raw;
      for (const auto& [bx, by] : blocks_in_order(52, 44, 16)) {
        const uint64_t number = by * 7 + bx;  // 52 pixels are seven blocks
        append_bursts(written, &surface.payload[number * 256], (surface.block_bits[number] + 7) / 8, 32);
        for (uint32_t i = 0; i < 64; ++i) {
          const uint32_t x = 8 * bx + i / 4 % 4 * 2 + i % 2, y = 8 * by + i / 16 * 2 + i / 2 % 2;
          const uint32_t word = frames[1].words[std::min(y, 43u) * 52 + std::min(x, 51u)];
          for (uint32_t byte = 0; byte < 4; ++byte) raw.push_back(static_cast<uint8_t>(word >> 8 * byte));
        }
      }
      append_bursts(written, surface.csb.data(), surface.csb.size(), 32);
      append_bursts(written, surface.tables.data(), surface.tables.size(), 32);
      ASSERT_TRUE(counted.toggles) << scheme;
      EXPECT_EQ(std::pair(counted.toggles->plain, counted.toggles->inverted), count_slowly(written, width));
      EXPECT_EQ(std::pair(counted.toggles->raw_plain, counted.toggles->raw_inverted),
                count_slowly(raw, width));
    }
}

TEST(BusToggles, WithoutASurfaceOfTheCallerAreTheSame) {
  const SampleFrame frame = mixed_frame(40, 24, PixelFormat::kRgba8, 3);
  const ModelOptions options{.toggle_bits = 32};
  SchemeStatistics stored;
  compress("vdcp", {frame, frame}, options, &stored);
  SurfaceEngine engine({*parse_scheme("vdcp")}, options);
  FrameStatistics out;
  for (int i = 0; i < 2; ++i) engine.process(frame.view(), out);
  EXPECT_EQ(out.schemes[0].toggles->plain, stored.toggles->plain);
  EXPECT_EQ(out.schemes[0].toggles->inverted, stored.toggles->inverted);
}

TEST(Engine, SkipsASchemeThatDoesNotSupportTheFormat) {
  SurfaceEngine engine({*parse_scheme("intel8"), *parse_scheme("red")}, {});
  FrameStatistics out;
  engine.process(mixed_frame(16, 8, PixelFormat::kRgb565, 1).view(), out);
  EXPECT_TRUE(out.schemes[0].skipped);
  EXPECT_EQ(out.schemes[0].blocks, 0u);
  EXPECT_EQ(out.schemes[1].blocks, 2u);
}

}  // namespace
}  // namespace tilepress
