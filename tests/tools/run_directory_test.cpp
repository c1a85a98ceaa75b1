// Run directory: what is written is read back, and what a kill leaves is repaired.
#include "tilepress/run_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tilepress/frame_pictures.h"
#include "tilepress/run_reader.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class RunDirectory : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "run-XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    base_ = pattern;
    path_ = base_ + "/deep/run";
    ASSERT_TRUE(set_run_option(options_, "scheme", "dcp vdcp:fvc=128,policy=2lfc"));
    info_.command = {"prog", "--with", "a \"quoted\" word, \xC3\xA9"};
    info_.program = "prog";
    info_.pid = 42;
    info_.via = "preload";
    info_.api = "EGL";
    info_.gl_vendor = "Mesa";
    info_.further = {{"note", "more"}};
  }
  void TearDown() override { fs::remove_all(base_); }

  /// Frame f of surface s: figures that differ by frame, surface and scheme.
  static FrameStatistics frame(uint64_t f, uint32_t s = 0) {
    FrameStatistics out;
    out.frame = f;
    out.surface = s;
    out.width = 16;
    out.height = 8;
    out.format = PixelFormat::kRgbx8;
    out.warmup = f == 0;
    out.time_ns = 1000 * f;
    out.metrics.unique_colors = f + 1;
    out.metrics.entropy = 1.0 / 3.0;
    for (uint64_t scheme = 0; scheme < 2; ++scheme) {
      SchemeStatistics row;
      row.blocks = 2;
      row.raw_bits = 4096;
      row.payload_bits = 1000 + 100 * scheme + 10 * f + s;
      row.bursts = 9 + scheme;
      row.csb_bits = 6;
      row.palette_bits = 66;
      out.schemes.push_back(row);
    }
    return out;
  }
  void write_frames(uint64_t count) {
    RunWriter writer;
    ASSERT_TRUE(writer.create(path_, info_, options_));
    for (uint64_t f = 0; f < count; ++f) ASSERT_TRUE(writer.append(frame(f)));
  }
  std::string text(const char* name) const {
    std::ifstream file(path_ + "/" + name);
    std::stringstream buffer;
    buffer << file.rdbuf();
    return buffer.str();
  }
  void add(const char* name, const std::string& tail) {
    std::ofstream(path_ + "/" + name, std::ios::app) << tail;
  }
  RunRecord read() {
    const auto record = read_run(path_);
    EXPECT_TRUE(record) << record.error().text;
    return record ? *record : RunRecord{};
  }
  /// Reads the run and closes it.
  RunRecord close(const RunEnd& end) {
    RunRecord record = read();
    const auto closed = close_run(end, record);
    EXPECT_TRUE(closed) << closed.error().text;
    return record;
  }
  std::string reading_error() {
    const auto record = read_run(path_);
    EXPECT_FALSE(record);
    return record ? "" : record.error().text;
  }

  std::string base_, path_;
  RunInfo info_;
  RunOptions options_;
};

TEST_F(RunDirectory, ReadsBackWhatWasWritten) {
  {
    RunWriter writer;
    ASSERT_TRUE(writer.create(path_, info_, options_));
    for (uint64_t f = 0; f < 3; ++f) ASSERT_TRUE(writer.append(frame(f)));
    ASSERT_TRUE(writer.append(frame(0, 1)));
    RunCounts counts;
    counts.seen = 6;
    counts.captured = 4;
    counts.dropped = 2;
    writer.set_counts(counts);
    ASSERT_TRUE(writer.finish("finished", ""));
  }
  const RunRecord run = read();
  EXPECT_EQ(run.state, "finished");
  EXPECT_EQ(run.info.command, info_.command);
  EXPECT_EQ(run.info.program, "prog");
  EXPECT_EQ(run.info.pid, 42);
  EXPECT_EQ(run.info.api, "EGL");
  EXPECT_EQ(run.info.gl_vendor, "Mesa");
  EXPECT_THAT(run.info.further, ::testing::Contains(std::make_pair("note", "more")));
  EXPECT_EQ(run.counts.seen, 6u);
  EXPECT_EQ(run.counts.dropped, 2u);
  EXPECT_THAT(run.scheme_names, ElementsAre("dcp", "vdcp:fvc=128,policy=2lfc"));
  ASSERT_EQ(run.frames.size(), 4u);
  EXPECT_EQ(run.frames[2].format, PixelFormat::kRgbx8);
  EXPECT_EQ(run.frames[2].metrics.unique_colors, 3u);
  EXPECT_EQ(run.frames[2].metrics.entropy, 1.0 / 3.0);
  EXPECT_EQ(run.frames[3].surface, 1u);
  ASSERT_EQ(run.frames[2].schemes.size(), 2u);
  EXPECT_EQ(run.frames[2].schemes[1].payload_bits, 1120u);
  // Frames 1 and 2 of surface 0; the two frames 0 are warmup.
  EXPECT_EQ(run.measured_frames, 2u);
  EXPECT_EQ(run.totals[0].raw_bits, 8192u);
  EXPECT_EQ(run.totals[0].payload_bits, 1010u + 1020u);
  EXPECT_EQ(run.totals[1].bursts, 20u);
}

TEST_F(RunDirectory, ItsJsonHasTheTotalsOfTheMeasuredFrames) {
  {
    RunWriter writer;
    ASSERT_TRUE(writer.create(path_, info_, options_));
    for (uint64_t f = 0; f < 3; ++f) ASSERT_TRUE(writer.append(frame(f)));
    ASSERT_TRUE(writer.finish("failed", "a reason"));
  }
  const auto json = nlohmann::json::parse(text("run.json"));
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["state"], "failed");
  EXPECT_EQ(json["reason"], "a reason");
  EXPECT_EQ(json["measured_frames"], 2);
  EXPECT_EQ(json["options"]["tile"], 32);
  const auto& dcp = json["schemes"][0];
  EXPECT_EQ(dcp["scheme"], "dcp");
  // moved = 2 frames · (9 bursts · 128 + 6 CSB + 66 palette) = 2448; raw = 8192.
  EXPECT_EQ(dcp["moved_bits"], 2448);
  EXPECT_DOUBLE_EQ(dcp["rate"], 8192.0 / 2448.0);
  EXPECT_DOUBLE_EQ(dcp["rate_payload"], 8192.0 / (1010 + 1020 + 12));
}

TEST_F(RunDirectory, SaysRunningUntilItIsFinished) {
  write_frames(1);
  EXPECT_EQ(read().state, "running");
}

TEST_F(RunDirectory, IsNeverOverwritten) {
  write_frames(2);
  const std::string before = text("frames.csv");
  RunWriter writer;
  const auto created = writer.create(path_, info_, options_);
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().kind, ErrorKind::kExists);
  EXPECT_EQ(created.error().text, path_ + ": already holds a run");
  EXPECT_FALSE(writer.is_open());
  EXPECT_EQ(text("frames.csv"), before);
}

TEST_F(RunDirectory, ReportsAFolderThatCannotBeMade) {
  std::ofstream(base_ + "/file") << "x";
  RunWriter writer;
  const auto created = writer.create(base_ + "/file/run", info_, options_);
  ASSERT_FALSE(created);
  EXPECT_THAT(created.error().text, HasSubstr(base_ + "/file/run: Not a directory"));
}

TEST_F(RunDirectory, AFullDiskLeavesWholeRowsOnly) {
  RunWriter writer;
  ASSERT_TRUE(writer.create(path_, info_, options_));
  ASSERT_TRUE(writer.append(frame(0)));
  const size_t schemes_size = text("schemes.csv").size();
  // A limit in the middle of the next frame's rows: write() comes back short, then fails.
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit tight{schemes_size + 20, old.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &tight);
  const auto appended = writer.append(frame(1));
  setrlimit(RLIMIT_FSIZE, &old);
  ASSERT_FALSE(appended);
  EXPECT_THAT(appended.error().text, HasSubstr("schemes.csv: File too large"));
  EXPECT_EQ(text("schemes.csv").size(), schemes_size);
}

TEST_F(RunDirectory, ReadingLeavesOutWhatIsStillBeingWritten) {
  write_frames(2);
  add("schemes.csv", "2,0,dcp,0,2,4096,10");
  RunRecord run = read();
  EXPECT_EQ(run.frames.size(), 2u);
  EXPECT_EQ(run.measured_frames, 1u);
}

TEST_F(RunDirectory, ClosingCutsTornRowsAndRowsOfAnIncompleteFrame) {
  write_frames(3);
  const std::string frames_before = text("frames.csv"), schemes_before = text("schemes.csv");
  std::string rows;
  append_schemes_rows(frame(3), {"dcp", "vdcp:fvc=128,policy=2lfc"}, rows);
  add("schemes.csv", rows);         // frame 3 has its rows here ...
  add("frames.csv", "3,0,16,8,R");  // ... and a torn one there

  RunEnd end;
  end.state = "killed by signal 9";
  end.signal = 9;
  const RunRecord run = close(end);
  EXPECT_EQ(text("frames.csv"), frames_before);
  EXPECT_EQ(text("schemes.csv"), schemes_before);
  EXPECT_EQ(run.frames.size(), 3u);
  const auto json = nlohmann::json::parse(text("run.json"));
  EXPECT_EQ(json["state"], "killed by signal 9");
  EXPECT_EQ(json["signal"], 9);
  EXPECT_EQ(json["counts"]["captured"], 3);
  EXPECT_EQ(json["counts"]["seen"], 3);
  EXPECT_EQ(json["measured_frames"], 2);
  EXPECT_EQ(json["program"], "prog");
}

TEST_F(RunDirectory, ClosingKeepsTheFailureThatTheRunNoted) {
  {
    RunWriter writer;
    ASSERT_TRUE(writer.create(path_, info_, options_));
    ASSERT_TRUE(writer.finish("failed", "disk full"));
  }
  RunEnd end;
  end.exit_status = 0;
  close(end);
  EXPECT_EQ(read().state, "failed");
  EXPECT_EQ(read().reason, "disk full");
}

TEST_F(RunDirectory, ClosingMakesUpForALostJson) {
  write_frames(2);
  fs::remove(path_ + "/run.json");
  close(RunEnd{});
  EXPECT_EQ(read().state, "finished");
  EXPECT_THAT(read().scheme_names, ElementsAre("dcp", "vdcp:fvc=128,policy=2lfc"));
}

TEST_F(RunDirectory, NamesTheFileAndTheRecordThatIsMalformed) {
  write_frames(2);
  add("frames.csv", "2,0,16,8,RGBX8,0,zero,1,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(reading_error(), path_ + "/frames.csv: record 4: time_ns: cannot read 'zero'");
}

TEST_F(RunDirectory, ASurplusFieldIsNotThatOfAMissingColumn) {
  write_frames(2);
  std::string rows = text("frames.csv");
  const std::string column = ",encode_ns";
  rows.erase(rows.find(column), column.size());
  std::ofstream(path_ + "/frames.csv") << rows;
  EXPECT_EQ(reading_error(), path_ + "/frames.csv: record 2: encode_ns: the field is missing");
}

TEST_F(RunDirectory, HasNoHeatMapOfASchemeThatSkipsTheSurface) {
  options_.schemes = {*parse_scheme("red"), *parse_scheme("intel8")};
  options_.heatmaps_every = 1;
  fs::create_directories(path_);
  FramePictures pictures;
  pictures.open(path_, options_);
  const std::vector<std::byte> bytes(8 * 8 * 4);
  for (const PixelFormat format : {PixelFormat::kRgba8, PixelFormat::kRgb565}) {
    SurfaceEngine engine(options_.schemes, options_.model);
    FrameStatistics out;
    out.surface = static_cast<uint32_t>(format);
    const SurfaceView view{bytes.data(), static_cast<ptrdiff_t>(traits(format).pixel_bits), 8, 8, format};
    engine.note_block_bits(pictures.bits_for(0));
    engine.process(view, out);
    ASSERT_TRUE(pictures.write(out, view));
    const std::string stem = path_ + "/heatmaps/" + std::to_string(out.surface) + "-000000-";
    EXPECT_TRUE(fs::exists(stem + "red.pgm"));
    EXPECT_EQ(fs::exists(stem + "intel8.pgm"), format == PixelFormat::kRgba8);
  }
}

TEST_F(RunDirectory, AnEmptyFolderHoldsNoRun) {
  fs::create_directories(path_);
  EXPECT_EQ(reading_error(), path_ + ": holds no run");
}

}  // namespace
}  // namespace tilepress
