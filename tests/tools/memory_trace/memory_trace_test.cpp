// Memory traces: addresses, orders and times of requests, against numbers derived by hand.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "memory_trace/block_log_reader.h"
#include "memory_trace/frame_accesses.h"
#include "memory_trace/memory_map.h"
#include "memory_trace/request_timeline.h"
#include "tilepress/block_log.h"
#include "tilepress/surface_engine.h"
#include "tilepress/tiler.h"

namespace tilepress {
namespace {

/// 20x20 pixels: 3x3 blocks, two of which lie in the second column of 16-pixel tiles. Block n fills n bursts.
CompressedSurface small_surface() {
  CompressedSurface surface;
  surface.scheme = *parse_scheme("vdcp");
  surface.width = surface.height = 20;
  surface.tile_side = 16;
  surface.burst_bits = 128;
  surface.csb_bits = 48;
  surface.table_bits = 2112;
  for (uint16_t n = 0; n < 9; ++n) surface.block_bits.push_back(static_cast<uint16_t>(n * 128));
  return surface;
}

std::vector<std::string> texts(const std::vector<MemoryFetch>& accesses) {
  std::vector<std::string> out;
  for (const MemoryFetch& access : accesses) {
    const char* part = access.part == SurfacePart::kPayload ? "payload" : access.part == SurfacePart::kCsb ? "csb" : "tables";
    out.push_back(std::string(part) + " " + std::to_string(access.offset_bytes) + " " + std::to_string(access.bursts));
  }
  return out;
}

using Texts = std::vector<std::string>;

TEST(MemoryMap, AlignsSurfacesToPagesAndPartsToCacheLines) {
  MemoryMap map(100);
  map.add(7, small_surface(), 2112);
  map.add(3, small_surface(), 0);
  // Nine slots of 256 bytes. CSB: 432 bits are 4 bursts, 64 bytes. Tables: 2112 bits are 17 bursts, 272 bytes.
  EXPECT_EQ(map.place(7).payload, 4096u);
  EXPECT_EQ(map.place(7).csb, 4096u + 9 * 256);
  EXPECT_EQ(map.place(7).tables, 4096u + 9 * 256 + 64);
  EXPECT_EQ(map.place(7).end, 4096u + 9 * 256 + 64 + 272);
  EXPECT_EQ(map.place(3).payload, 8192u);
  EXPECT_EQ(map.place(3).end, map.place(3).tables);
}

TEST(MemoryMap, AlignsPartsToBurstsAboveACacheLine) {
  CompressedSurface surface = small_surface();
  surface.burst_bits = 2048;
  MemoryMap map(0);
  map.add(0, surface, 2112);
  EXPECT_EQ(map.place(0).csb, 9u * 256);
  EXPECT_EQ(map.place(0).tables, 9u * 256 + 256);
  EXPECT_EQ(map.place(0).end, 9u * 256 + 256 + 512);
}

TEST(FrameAccesses, WritesGoTileByTileThenCsbAndTables) {
  // Tiles of 2x2 blocks: 0 1 3 4, then 2 5, then 6 7, then 8. Block 0 fills nothing.
  EXPECT_EQ(texts(frame_writes(small_surface(), TracedForm::kCompressed)),
            (Texts{"payload 256 1", "payload 768 3", "payload 1024 4", "payload 512 2", "payload 1280 5",
                   "payload 1536 6", "payload 1792 7", "payload 2048 8", "csb 0 4", "tables 0 17"}));
}

TEST(FrameAccesses, DisplayReadsTablesThenRowsOfBlocksEachCsbBurstOnce) {
  // 48 bits a block: entries end in bursts 0 0 1 1 1 2 2 2 3.
  EXPECT_EQ(texts(display_reads(small_surface(), TracedForm::kCompressed)),
            (Texts{"tables 0 17", "csb 0 1", "payload 256 1", "csb 16 1", "payload 512 2", "payload 768 3",
                   "payload 1024 4", "csb 32 1", "payload 1280 5", "payload 1536 6", "payload 1792 7", "csb 48 1",
                   "payload 2048 8"}));
}

TEST(FrameAccesses, RawFramesMoveEveryBurstOfEveryBlockAndNothingElse) {
  for (const auto& accesses : {frame_writes(small_surface(), TracedForm::kRaw), display_reads(small_surface(), TracedForm::kRaw)}) {
    ASSERT_EQ(accesses.size(), 9u);
    for (const MemoryFetch& access : accesses) {
      EXPECT_EQ(access.part, SurfacePart::kPayload);
      EXPECT_EQ(access.bursts, 16u);
    }
  }
}

struct NotedRequests : RequestSink {
  std::vector<std::string> lines;
  Result<void> take(const MemoryRequest& request) override {
    lines.push_back(std::to_string(request.time_ps) + (request.write ? " W " : " R ") + std::to_string(request.address));
    return {};
  }
};

AccessStream stream_of(std::vector<MemoryFetch> accesses, bool write, uint64_t begin, uint64_t end) {
  return {.write = write, .begin_ps = begin, .end_ps = end, .place = {0, 4096, 8192, 8192}, .accesses = std::move(accesses), .stored = nullptr};
}

TEST(RequestTimeline, SpreadsTheRequestsOfAStreamEvenly) {
  NotedRequests noted;
  RequestTimeline timeline({16, 16}, noted);
  timeline.add(stream_of({{SurfacePart::kPayload, 0, 2}, {SurfacePart::kCsb, 16, 1}}, true, 100, 110));
  ASSERT_TRUE(timeline.finish());
  EXPECT_EQ(noted.lines, (Texts{"100 W 0", "103 W 16", "106 W 4112"}));
}

TEST(RequestTimeline, MergesTwoStreamsByTimeAndStopsAtATime) {
  NotedRequests noted;
  RequestTimeline timeline({16, 16}, noted);
  timeline.add(stream_of({{SurfacePart::kPayload, 0, 2}}, true, 0, 20));
  timeline.add(stream_of({{SurfacePart::kPayload, 256, 4}}, false, 0, 20));
  ASSERT_TRUE(timeline.advance_to(10));
  EXPECT_EQ(noted.lines, (Texts{"0 W 0", "0 R 256", "5 R 272"}));
  ASSERT_TRUE(timeline.finish());
  EXPECT_EQ(noted.lines, (Texts{"0 W 0", "0 R 256", "5 R 272", "10 W 16", "10 R 288", "15 R 304"}));
}

TEST(RequestTimeline, MakesOneRequestOfBurstsInOneAlignedPiece) {
  NotedRequests noted;
  RequestTimeline timeline({16, 64}, noted);
  // Five bursts from 48 on lie in two pieces. The next access begins in the second, the last in one of its own.
  timeline.add(stream_of({{SurfacePart::kPayload, 48, 3}, {SurfacePart::kPayload, 96, 2}, {SurfacePart::kPayload, 256, 1}}, false, 0, 3));
  ASSERT_TRUE(timeline.finish());
  EXPECT_EQ(noted.lines, (Texts{"0 R 0", "1 R 64", "2 R 256"}));
}

/// A run of two frames with their blocks in a log.
class BlockLogFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tilepress-log-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ / kBlockLogName; }

  /// Writes the log, and keeps what the engine stored.
  void write_log(bool data) {
    RunOptions options;
    options.schemes = {*parse_scheme("ras"), *parse_scheme("vdcp:fvc=16")};
    options.block_log = options.schemes[1].text;
    options.block_log_data = data;
    BlockLog log;
    ASSERT_TRUE(log.create(folder_, options));
    SurfaceEngine engine(options.schemes, options.model);
    std::vector<uint32_t> pixels(20 * 13);
    for (uint32_t frame = 0; frame < 2; ++frame) {
      for (uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = (i * 7 % 40 + frame) * 0x01010101u;
      SurfaceView view;
      view.top_row = reinterpret_cast<const std::byte*>(pixels.data());
      view.width = 20;
      view.height = 13;
      view.pitch_bytes = 80;
      BlockBits bits;
      FrameStatistics statistics;
      statistics.frame = frame;
      statistics.time_ns = 5 * frame;
      std::vector<CompressedSurface> surfaces(2);
      engine.note_block_bits(&bits);
      engine.process(view, statistics, surfaces);
      stored_.push_back(surfaces[1]);
      ASSERT_TRUE(log.append(log.record(statistics, bits, surfaces)));
    }
  }

  std::string bytes() const {
    std::ifstream in(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& content) const { std::ofstream(path(), std::ios::binary | std::ios::trunc) << content; }

  std::filesystem::path folder_;
  std::vector<CompressedSurface> stored_;
};

TEST_F(BlockLogFile, GivesBackWhatTheEngineStored) {
  write_log(true);
  BlockLogReader log;
  ASSERT_TRUE(log.open(path()));
  ASSERT_EQ(log.frames().size(), 2u);
  EXPECT_EQ(log.frames()[1].time_ns, 5u);
  for (size_t i = 0; i < 2; ++i) {
    CompressedSurface read;
    ASSERT_TRUE(log.read(i, read));
    EXPECT_EQ(read.block_bits, stored_[i].block_bits);
    EXPECT_EQ(read.csb, stored_[i].csb);
    EXPECT_EQ(read.tables, stored_[i].tables);
    EXPECT_EQ(read.table_bits, stored_[i].table_bits);
    for (size_t block = 0; block < read.block_bits.size(); ++block) {
      const size_t at = block * read.slot_bytes(), filled = (read.block_bits[block] + 7u) / 8;
      EXPECT_EQ(std::memcmp(&read.payload[at], &stored_[i].payload[at], filled), 0) << block;
    }
  }
}

TEST_F(BlockLogFile, WithoutDataHoldsSizesAlone) {
  write_log(false);
  BlockLogReader log;
  ASSERT_TRUE(log.open(path()));
  CompressedSurface read;
  ASSERT_TRUE(log.read(1, read));
  EXPECT_EQ(read.block_bits, stored_[1].block_bits);
  EXPECT_TRUE(read.payload.empty());
}

TEST_F(BlockLogFile, CutAnywhereKeepsTheWholeFramesBefore) {
  write_log(true);
  const std::string whole = bytes();
  BlockLogReader first;
  ASSERT_TRUE(first.open(path()));
  const uint64_t second_frame = first.frames()[1].offset;
  for (size_t size = 0; size < whole.size(); size += 31) {
    replace(whole.substr(0, size));
    BlockLogReader log;
    const auto opened = log.open(path());
    if (!opened) {
      EXPECT_LT(size, 100u);
      continue;
    }
    EXPECT_EQ(log.frames().size(), size >= second_frame ? 1u : 0u) << size;
    CompressedSurface read;
    for (size_t i = 0; i < log.frames().size(); ++i) EXPECT_TRUE(log.read(i, read));
  }
}

TEST_F(BlockLogFile, AnyDamagedByteIsReadOrRefusedAndNothingElse) {
  write_log(true);
  const std::string whole = bytes();
  CompressedSurface read;
  const size_t heads = sizeof(BlockLogStart) + sizeof(BlockLogRecord) + 30;
  for (size_t at = 0; at < whole.size(); at += at < heads ? 1 : 13)
    for (const char change : {'\x01', '\xFF'}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      replace(damaged);
      BlockLogReader log;
      if (!log.open(path())) continue;
      for (size_t i = 0; i < log.frames().size(); ++i) {
        if (!log.read(i, read)) continue;
        EXPECT_EQ(read.block_bits.size(), read.blocks());
      }
    }
}

TEST_F(BlockLogFile, NeedsASchemeOfTheRun) {
  RunOptions options;
  options.schemes = {*parse_scheme("ras")};
  options.block_log = "vdcp";
  BlockLog log;
  const auto made = log.create(folder_, options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kBadValue);
}

}  // namespace
}  // namespace tilepress
