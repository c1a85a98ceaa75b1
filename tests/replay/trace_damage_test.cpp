// Damaged traces: cut, corrupt and hostile files are reported, and nothing before the damage is lost.
#include <brotli/encode.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tilepress/trace_summary.h"
#include "trace_builder.h"

namespace tilepress {
namespace {

using testing::HasSubstr;

const std::string kTraces = TILEPRESS_TEST_TRACES;

TraceSummary summary_of(const Bytes& file) {
  const auto summary = summarize_trace(std::span(file));
  EXPECT_TRUE(summary) << summary.error().text;
  return summary ? *summary : TraceSummary{};
}

std::string refusal_of(const Bytes& file) {
  const auto summary = summarize_trace(std::span(file));
  EXPECT_FALSE(summary);
  return summary ? "" : summary.error().text;
}

Bytes bytes_of(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

TEST(CutTrace, KeepsEverythingBeforeTheCut) {
  TraceBuilder trace;
  for (int i = 0; i < 10; ++i) trace.swap(3);
  uint64_t most_frames = 0;
  for (size_t length = 1; length < trace.stream().size(); ++length) {
    const Bytes stream(trace.stream().begin(), trace.stream().begin() + static_cast<ptrdiff_t>(length));
    const TraceSummary summary = summary_of(TraceBuilder::snappy_file(stream));
    EXPECT_GE(summary.frames + 1, most_frames) << length;  // a swap whose return is cut through is lost
    EXPECT_NE(summary.state, TraceState::kCorrupt) << length;
    most_frames = std::max(most_frames, summary.frames);
    if (length + 1 == trace.stream().size()) {
      EXPECT_EQ(summary.frames, 9u);
    }
  }
  EXPECT_EQ(most_frames, 10u);
}

TEST(CutTrace, IsReportedAtEveryLengthOfTheFile) {
  TraceBuilder trace;
  for (int i = 0; i < 40; ++i) trace.swap(3);
  const Bytes whole = trace.file(64);
  for (size_t length = 3; length < whole.size(); ++length) {
    const Bytes file(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length));
    const TraceSummary summary = summary_of(file);
    EXPECT_TRUE(summary.frames < 40 || summary.open_calls == 1) << length;
    EXPECT_NE(summary.state, TraceState::kCorrupt) << length;
  }
}

TEST(CutTrace, KeepsAllOfACutChunkThatArrived) {
  TraceBuilder trace;
  trace.call("glBufferData", {blob(70000)});  // a long run: literals and overlapping copies
  for (uint64_t i = 0; i < 500; ++i) trace.swap(i * 7919 % 60000 + 1);
  Bytes file = trace.file();
  file.resize(file.size() - 5);
  const TraceSummary summary = summary_of(file);
  EXPECT_EQ(summary.state, TraceState::kTruncated);
  EXPECT_EQ(summary.frames, 500u);  // the return of the last swap is cut off, the swap itself is there
}

TEST(CutTrace, OfARecordedProgramKeepsItsFirstFrames) {
  std::ifstream stream(kTraces + "/glmark2-desktop-egl.trace", std::ios::binary);
  Bytes file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  file.resize(300000);
  const TraceSummary summary = summary_of(file);
  EXPECT_EQ(summary.state, TraceState::kTruncated);
  EXPECT_EQ(summary.frames, 14u);
}

TEST(CutTrace, InABrotliContainerIsReported) {
  TraceBuilder trace;
  for (uint64_t i = 0; i < 5000; ++i) trace.swap(i * 7919 % 60000 + 1);
  Bytes file(trace.stream().size() + 1000);
  size_t length = file.size();
  ASSERT_TRUE(BrotliEncoderCompress(5, 22, BROTLI_MODE_GENERIC, trace.stream().size(), trace.stream().data(),
                                    &length, file.data()));
  file.resize(length);
  EXPECT_EQ(summary_of(file).frames, 5000u);
  file.resize(length / 2);
  const TraceSummary summary = summary_of(file);
  EXPECT_EQ(summary.state, TraceState::kTruncated);
  EXPECT_GT(summary.frames, 0u);
  EXPECT_LT(summary.frames, 5000u);
}

TEST(DamagedTrace, TellsWhereAndWhy) {
  TraceBuilder trace;
  trace.swap(3);
  const uint64_t good_bytes = trace.stream().size();
  trace.raw({9});
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kCorrupt);
  EXPECT_EQ(summary.reason, "unknown event 9");
  EXPECT_EQ(summary.offset, good_bytes + 1);
  EXPECT_EQ(summary.frames, 1u);
}

TEST(DamagedTrace, IsCorruptAtTheOffsetWhereItsDamagedChunkBegins) {
  TraceBuilder trace;
  for (int i = 0; i < 40; ++i) trace.swap(3);
  Bytes file = trace.file(64);
  const size_t second_chunk = 2 + 4 + file[2];  // behind the signature and the first chunk, which is short
  for (size_t i = 0; i < 4; ++i) file[second_chunk + i] = 0xff;
  const TraceSummary summary = summary_of(file);
  EXPECT_EQ(summary.state, TraceState::kCorrupt);
  EXPECT_EQ(summary.offset, 64u);
}

TEST(DamagedTrace, WithAnyByteChangedIsReadWithoutHarm) {
  TraceBuilder trace;
  trace.make_current(3, 100);
  trace.viewport(10, 20);
  for (int i = 0; i < 5; ++i) trace.swap(3);
  for (size_t at = 0; at < trace.stream().size(); ++at) {
    for (const uint8_t value : {0x00, 0x01, 0x0b, 0x7f, 0x80, 0xff}) {
      Bytes stream = trace.stream();
      stream[at] = value;
      const Bytes file = TraceBuilder::snappy_file(stream);
      const auto summary = summarize_trace(std::span(file));
      EXPECT_TRUE(summary ? summary->frames <= 6 : !summary.error().text.empty()) << at;
    }
  }
}

TEST(HostileTrace, AViewportBeyondAllSizesIsNoSurface) {
  TraceBuilder trace;
  trace.make_current(3, 1);
  trace.viewport(10, 20);
  trace.call("glViewport", {number(INT64_MAX), number(INT64_MAX), number(64), number(INT64_MAX)});
  trace.swap(3);
  const TraceSummary summary = summary_of(trace.file());
  ASSERT_EQ(summary.surfaces.size(), 1u);
  EXPECT_EQ(summary.surfaces[0].width, 10u);
  EXPECT_EQ(summary.surfaces[0].height, 20u);
}

TEST(HostileTrace, WithEndlessNestingIsCorrupt) {
  TraceBuilder trace;
  trace.raw({0, 0, 0, 1, 'f', 1, 1, 'a', 1, 0});
  for (int i = 0; i < 100000; ++i) trace.raw({0x0b, 1});
  EXPECT_THAT(summary_of(trace.file()).reason, HasSubstr("nested too deeply"));
}

TEST(HostileTrace, WithAGiantLengthIsTruncatedNotAllocated) {
  for (const uint8_t type : {0x07, 0x08, 0x0b, 0x0f}) {
    TraceBuilder trace;
    trace.raw(
        {0, 0, 0, 14, 'e', 'g', 'l', 'S', 'w', 'a', 'p', 'B', 'u', 'f', 'f', 'e', 'r', 's', 0, 1, 1, type});
    trace.raw({0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f});
    EXPECT_EQ(summary_of(trace.file()).state, TraceState::kTruncated);
  }
}

TEST(HostileTrace, WithGiantChunksIsCorrupt) {
  EXPECT_THAT(summary_of({'a', 't', 0xff, 0xff, 0xff, 0xff, 0}).reason, HasSubstr("claims 4294967295 bytes"));
  // A block that says it unpacks to 2 GiB.
  EXPECT_THAT(summary_of({'a', 't', 6, 0, 0, 0, 0x80, 0x80, 0x80, 0x80, 0x08, 0}).reason,
              HasSubstr("unpack to"));
}

TEST(HostileTrace, WithManyEmptyChunksIsReadInALoop) {
  Bytes file = {'a', 't'};
  for (int i = 0; i < 200000; ++i) append(file, {1, 0, 0, 0, 0});
  append(file, {3, 0, 0, 0, 1, 0, 6});
  EXPECT_EQ(summary_of(file).state, TraceState::kTruncated);
}

TEST(HostileTrace, ThatUnpacksToFarMoreThanItsSizeIsStopped) {
  const Bytes zeros(64 << 20);
  Bytes stream = TraceBuilder().stream();
  append(stream, {0, 0, 0, 1, 'f', 1, 1, 'a', 1, 0, 0x08, 0xff, 0xff, 0xff, 0xff, 0x7f});
  append(stream, zeros);
  Bytes file(1 << 20);
  size_t length = file.size();
  ASSERT_TRUE(
      BrotliEncoderCompress(5, 22, BROTLI_MODE_GENERIC, stream.size(), stream.data(), &length, file.data()));
  file.resize(length);
  const auto summary = summarize_trace(std::span(file), {.free_stream_bytes = 1 << 20, .max_expansion = 10});
  ASSERT_TRUE(summary) << summary.error().text;
  EXPECT_EQ(summary->state, TraceState::kCorrupt);
  EXPECT_THAT(summary->reason, HasSubstr("far more than its size justifies"));
}

TEST(FileThatIsNoTrace, IsNamedForWhatItIs) {
  EXPECT_EQ(refusal_of({}), "is empty");
  EXPECT_EQ(refusal_of(bytes_of("just a few words of text, and then some more of it\n")),
            "is not an apitrace trace");
  EXPECT_EQ(refusal_of(bytes_of("\x7f"
                                "ELF\x02\x01\x01")),
            "is not an apitrace trace");
  EXPECT_THAT(refusal_of({0x28, 0xb5, 0x2f, 0xfd, 0, 0}), HasSubstr("zstd"));
  EXPECT_EQ(refusal_of(TraceBuilder::snappy_file({9, 9})),
            "has trace format version 9; versions up to 6 can be read");
  const auto folder = summarize_trace(kTraces);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text, "is a directory, not a trace");
  EXPECT_EQ(folder.error().kind, ErrorKind::kUnsupported);
  const auto nothing = summarize_trace(kTraces + "/none.trace");
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().text, "No such file or directory");
  EXPECT_EQ(nothing.error().kind, ErrorKind::kFile);
}

}  // namespace
}  // namespace tilepress
