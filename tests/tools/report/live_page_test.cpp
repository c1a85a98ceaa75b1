// Tests of the live page and of the screen made from it.
#include "tilepress/live_page.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <thread>

#include "live/capture_screen.h"

namespace tilepress {
namespace {

class LivePageTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/live-page-test-XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
    info_.program = "gears";
    info_.pid = 4711;
    options_.schemes = {*parse_scheme("dcp"), *parse_scheme("ras")};
  }
  void TearDown() override {
    unlink((folder_ + "/live").c_str());
    rmdir(folder_.c_str());
  }
  bool page_exists() const {
    struct stat status {};
    return stat((folder_ + "/live").c_str(), &status) == 0;
  }
  /// A frame whose numbers all follow from `n`.
  void update(LiveWriter& writer, uint64_t n) {
    FrameStatistics frame;
    frame.frame = n;
    frame.width = 640;
    frame.height = 480;
    frame.readback_ns = 2'000'000;
    frame.encode_ns = 4'000'000;
    frame.metrics.fvc_coverage = 0.75;
    SchemeStatistics sizes;
    sizes.raw_bits = 4 * 128 * n;
    sizes.bursts = n;
    frame.schemes = {sizes, sizes};
    RunCounts counts;
    counts.seen = counts.captured = n;
    writer.update(frame, frame.schemes, counts, 1, 3);
  }
  std::string folder_;
  RunInfo info_;
  RunOptions options_;
};

TEST_F(LivePageTest, AReaderSeesTheLastUpdate) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  update(writer, 10);
  LiveReader reader;
  ASSERT_TRUE(reader.open(folder_));
  LiveState state{};
  ASSERT_TRUE(reader.read(state));
  EXPECT_STREQ(state.program, "gears");
  EXPECT_EQ(state.pid, 4711);
  EXPECT_EQ(state.captured, 10u);
  EXPECT_EQ(state.queued, 1u);
  EXPECT_EQ(state.scheme_count, 2u);
  EXPECT_STREQ(state.schemes[1].name, "ras");
  EXPECT_EQ(state.schemes[1].raw_bits, 5120u);
  EXPECT_EQ(state.schemes[1].moved_bits, 1280u);
  EXPECT_EQ(state.readback_sum_ns, 2'000'000u);
  update(writer, 11);
  ASSERT_TRUE(reader.read(state));
  EXPECT_EQ(state.captured, 11u);
  EXPECT_EQ(state.readback_sum_ns, 4'000'000u);
}

TEST_F(LivePageTest, ThePageGoesWithTheRunAndAReaderOutlivesIt) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  update(writer, 3);
  LiveReader reader;
  ASSERT_TRUE(reader.open(folder_));
  writer.close();
  EXPECT_FALSE(page_exists());
  update(writer, 4);  // after the end: nothing happens
  LiveState state{};
  ASSERT_TRUE(reader.read(state));
  EXPECT_EQ(state.captured, 3u);
}

TEST_F(LivePageTest, SnapshotsAreNeverTorn) {
  LiveWriter writer;
  writer.open(folder_, info_, options_);
  update(writer, 1);
  LiveReader reader;
  ASSERT_TRUE(reader.open(folder_));
  std::atomic<bool> done{false};
  std::thread thread([&] {
    for (uint64_t n = 2; n < 20000; ++n) update(writer, n);
    done = true;
  });
  uint64_t last = 0;
  while (!done) {
    LiveState state{};
    if (!reader.read(state)) continue;
    EXPECT_EQ(state.captured, state.frame);
    EXPECT_EQ(state.schemes[0].raw_bits, 512 * state.frame);
    EXPECT_EQ(state.schemes[1].moved_bits, 128 * state.frame);
    EXPECT_GE(state.frame, last);
    last = state.frame;
  }
  thread.join();
}

TEST_F(LivePageTest, OtherFilesAreRefused) {
  LiveReader reader;
  const auto missing = reader.open(folder_);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().text.find("/live: No such file"), std::string::npos) << missing.error().text;
  std::ofstream(folder_ + "/live") << std::string(sizeof(LivePage), 'x');
  const auto foreign = reader.open(folder_);
  ASSERT_FALSE(foreign);
  EXPECT_NE(foreign.error().text.find("not a live page of this version"), std::string::npos)
      << foreign.error().text;
  std::ofstream(folder_ + "/live") << "TPLIVE";
  EXPECT_FALSE(reader.open(folder_));
}

TEST_F(LivePageTest, APageThatCannotBeMadeIsNoError) {
  LiveWriter writer;
  writer.open(folder_ + "/missing", info_, options_);
  update(writer, 1);
  writer.close();
}

TEST(CaptureScreen, ShowsSpeedRatesAndCosts) {
  WatchedCapture capture;
  LiveState& now = capture.now;
  std::strcpy(now.program, "gears\x1b[2J");
  now.pid = 42;
  now.width = 720;
  now.height = 1280;
  now.captured = now.seen = 150;
  now.fvc_coverage = 0.875;
  now.readback_sum_ns = 300'000'000;
  now.queue_depth = 3;
  now.scheme_count = 1;
  std::strcpy(now.schemes[0].name, "vdcp:fvc=128");
  now.schemes[0].raw_bits = 4000;
  now.schemes[0].moved_bits = 1000;
  capture.before = now;
  capture.before.captured = 90;
  capture.before.readback_sum_ns = 180'000'000;
  capture.elapsed_s = 2;
  // (150 - 90) / 2 s = 30 frames/s; (300 - 180) ms / 60 frames = 2 ms.
  EXPECT_DOUBLE_EQ(frames_per_second(capture), 30);
  std::string text;
  for (const std::string& line : capture_lines(capture, 200)) text += line + "\n";
  EXPECT_NE(text.find("gears?[2J (42)  720x1280"), std::string::npos) << text;
  EXPECT_NE(text.find("30.0 frames/s"), std::string::npos) << text;
  EXPECT_NE(text.find("FVC coverage 87.5 %"), std::string::npos) << text;
  EXPECT_NE(text.find("readback 2.00 ms"), std::string::npos) << text;
  // A rate of 4 is half a bar of 24 columns.
  EXPECT_NE(text.find("vdcp:fvc=128   4.000       -  ############............"), std::string::npos) << text;
  for (const std::string& line : capture_lines(capture, 40)) EXPECT_LE(line.size(), 40u);
}

TEST(CaptureScreen, NothingIsCutAtAnyWidth) {
  WatchedCapture capture;
  LiveState& now = capture.now;
  std::strcpy(now.program, "glmark2-es2");
  now.pid = 1234567;
  now.width = 1920;
  now.height = 1080;
  now.captured = now.seen = 123456;
  now.queue_depth = 3;
  now.scheme_count = 2;
  std::strcpy(now.schemes[0].name, "dcp");
  std::strcpy(now.schemes[1].name, "fbc");
  for (int i = 0; i < 2; ++i) {
    now.schemes[i].raw_bits = now.schemes[i].frame_raw_bits = 4000;
    now.schemes[i].moved_bits = now.schemes[i].frame_moved_bits = 1000;
  }
  now.schemes[1].extra_bits = 1000;  // 4000 / (1000 + 1000) = 2
  for (const size_t columns : {40u, 80u, 120u}) {
    std::string text;
    for (const std::string& line : capture_lines(capture, columns)) {
      EXPECT_LE(line.size(), columns) << line;
      text += line + "\n";
    }
    for (const char* field : {"(1234567)", "1920x1080", "captured 123456", "unsupported 0", "queue 0/3",
                              "readback 0.00 ms", "compress 0.00 ms", "+extra"})
      EXPECT_NE(text.find(field), std::string::npos) << field << " at " << columns << ":\n" << text;
    EXPECT_NE(text.find("fbc        4.000   4.000   2.000"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace tilepress
