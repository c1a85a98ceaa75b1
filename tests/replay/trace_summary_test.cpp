// Trace summaries: of recorded traces, whose figures `apitrace dump` and `apitrace info` gave, and of small
// traces made for the purpose.
#include "tilepress/trace_summary.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "trace_builder.h"

namespace tilepress {
namespace {

const std::string kTraces = TILEPRESS_TEST_TRACES;

TraceSummary summary_of(const Bytes& file) {
  const auto summary = summarize_trace(std::span(file));
  EXPECT_TRUE(summary) << summary.error().text;
  return summary ? *summary : TraceSummary{};
}

TEST(RecordedTrace, OfAnEglProgramGivesItsFramesAndSurface) {
  const auto trace = summarize_trace(kTraces + "/glmark2-desktop-egl.trace");
  ASSERT_TRUE(trace) << trace.error().text;
  EXPECT_EQ(trace->state, TraceState::kComplete);
  EXPECT_EQ(trace->container, "snappy");
  EXPECT_EQ(trace->version, 6u);
  EXPECT_EQ(trace->program, "/usr/bin/glmark2-es2");
  EXPECT_EQ(trace->api, TraceApi::kEgl);
  EXPECT_EQ(trace->contexts, "OpenGL ES 2.0");
  EXPECT_EQ(trace->calls, 16613u);
  EXPECT_EQ(trace->stream_bytes, 3094600u);
  EXPECT_EQ(trace->frames, 69u);
  ASSERT_EQ(trace->surfaces.size(), 1u);
  EXPECT_EQ(trace->surfaces[0].id, 0x55c28972b530u);
  EXPECT_EQ(trace->surfaces[0].width, 720u);
  EXPECT_EQ(trace->surfaces[0].height, 1280u);
  EXPECT_FALSE(trace->duration_ns);
}

TEST(RecordedTrace, OfAGlxProgramGivesItsFramesAndSurface) {
  const auto trace = summarize_trace(kTraces + "/glmark2-desktop-glx.trace");
  ASSERT_TRUE(trace) << trace.error().text;
  EXPECT_EQ(trace->api, TraceApi::kGlx);
  EXPECT_EQ(trace->contexts, "OpenGL");
  EXPECT_EQ(trace->calls, 14336u);
  EXPECT_EQ(trace->frames, 57u);
  ASSERT_EQ(trace->surfaces.size(), 1u);
  EXPECT_EQ(trace->surfaces[0].width, 720u);
  EXPECT_EQ(trace->surfaces[0].height, 1280u);
}

TEST(RecordedTrace, InABrotliContainerIsReadAndTellsItsDuration) {
  const auto trace = summarize_trace(kTraces + "/browser-map-egl.trace");
  ASSERT_TRUE(trace) << trace.error().text;
  EXPECT_EQ(trace->container, "brotli");
  EXPECT_EQ(trace->contexts, "OpenGL ES 3.2");
  EXPECT_EQ(trace->stream_bytes, 30979699u);
  EXPECT_EQ(trace->frames, 92u);
  // Viewports of off-screen framebuffers reach 1024x128; the window is what eglQuerySurface said.
  ASSERT_EQ(trace->surfaces.size(), 1u);
  EXPECT_EQ(trace->surfaces[0].width, 720u);
  EXPECT_EQ(trace->surfaces[0].height, 1280u);
  // First and last glGetInteger64v(GL_TIMESTAMP): 2888727257584 and 2911140177332.
  ASSERT_TRUE(trace->duration_ns);
  EXPECT_EQ(*trace->duration_ns, 2911140177332u - 2888727257584u);
}

TEST(TraceSummary, CountsFramesOfEachSurfaceInOrderOfPresentation) {
  TraceBuilder trace;
  trace.make_current(7, 100);
  trace.viewport(64, 32);
  trace.swap(7);
  trace.make_current(5, 100);
  trace.viewport(16, 48);
  for (int i = 0; i < 3; ++i) trace.swap(5);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.frames, 4u);
  ASSERT_EQ(summary.surfaces.size(), 2u);
  EXPECT_EQ(summary.surfaces[0].id, 7u);
  EXPECT_EQ(summary.surfaces[0].frames, 1u);
  EXPECT_EQ(summary.surfaces[1].frames, 3u);
  EXPECT_EQ(summary.surfaces[1].width, 16u);
  EXPECT_EQ(summary.surfaces[1].height, 48u);
}

TEST(TraceSummary, TakesSizesFromViewportsOfTheWindowAlone) {
  TraceBuilder trace;
  trace.make_current(7, 100);
  trace.viewport(64, 32);
  trace.call("glBindFramebuffer", {number(0x8D40), number(3)});
  trace.viewport(4096, 4096);
  trace.call("glBindFramebuffer", {number(0x8D40), number(0)});
  trace.viewport(32, 40);
  trace.swap(7);
  const TraceSummary summary = summary_of(trace.file());
  ASSERT_EQ(summary.surfaces.size(), 1u);
  EXPECT_EQ(summary.surfaces[0].width, 64u);  // a retracer's windows only grow
  EXPECT_EQ(summary.surfaces[0].height, 40u);
}

TEST(TraceSummary, KeepsThreadsApart) {
  TraceBuilder trace;
  trace.make_current(1, 100, 0);
  trace.make_current(2, 200, 1);
  const uint64_t slow = trace.enter("glViewport", {number(0), number(0), number(8), number(9)}, 0);
  trace.viewport(80, 90, 1);
  trace.leave(slow);
  trace.swap(1, 0);
  trace.swap(2, 1);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.threads, 2u);
  ASSERT_EQ(summary.surfaces.size(), 2u);
  EXPECT_EQ(summary.surfaces[0].width, 8u);
  EXPECT_EQ(summary.surfaces[1].width, 80u);
}

TEST(TraceSummary, ReadsSizesOfPbuffersAndVersionsOfContexts) {
  TraceBuilder trace;
  trace.call("eglBindAPI", {number(0x30A2)}, number(1));
  trace.call("eglCreateContext",
             {pointer(1), pointer(2), pointer(0),
              array({number(0x3098), number(4), number(0x30FB), number(1), number(0x3038)})},
             pointer(100));
  trace.call("eglCreatePbufferSurface",
             {pointer(1), pointer(2),
              array({number(0x3057), number(320), number(0x3056), number(200), number(0x3038)})},
             pointer(7));
  trace.make_current(7, 100);
  trace.swap(7);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.contexts, "OpenGL 4.1");
  ASSERT_EQ(summary.surfaces.size(), 1u);
  EXPECT_EQ(summary.surfaces[0].width, 320u);
  EXPECT_EQ(summary.surfaces[0].height, 200u);
}

TEST(TraceSummary, ReadsEveryKindOfValue) {
  TraceBuilder trace;
  Bytes structure = {0x0c, 5};  // definition 5: two members
  append_text(structure, "pair");
  append(structure, {2, 1, 'a', 1, 'b', 0x01, 0x02});
  const Bytes structure_again = {0x0c, 5, 0x00, 0x00};
  Bytes enumeration = {0x09, 0, 1};
  append_text(enumeration, "GL_ONE");
  append(enumeration, {0x04, 1, 0x04, 1});
  Bytes bitmask = {0x0a, 0, 1};
  append_text(bitmask, "BIT");
  append(bitmask, {1, 1});
  Bytes representation = {0x0e};
  append(representation, text("people"));
  append(representation, blob(3));
  trace.call("glAll", {{0x00},
                       {0x01},
                       {0x02},
                       {0x03, 5},
                       number(6),
                       {0x05, 0, 0, 0, 0},
                       {0x06, 0, 0, 0, 0, 0, 0, 0, 0},
                       text("x"),
                       blob(9),
                       enumeration,
                       bitmask,
                       array({number(1), structure}),
                       structure_again,
                       pointer(UINT64_MAX),
                       representation,
                       {0x0f, 2, 'w', 0x80, 0x01}});
  trace.swap(7);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kComplete) << summary.reason;
  EXPECT_EQ(summary.calls, 2u);
  EXPECT_EQ(summary.frames, 1u);
}

TEST(TraceSummary, ReadsBacktracesAndFlags) {
  TraceBuilder trace;
  const uint64_t call = trace.enter("glFlush", {});
  Bytes frame = {1, call > 255 ? uint8_t{0} : static_cast<uint8_t>(call), 4, 2, 9, 1};
  append_text(frame, "module");
  append(frame, {4, 20, 0, 9, 5, 1, 0});  // frame 9 in full, then frame 9 by its number; flags; end
  for (const uint8_t byte : frame) trace.raw({byte});
  trace.swap(7);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kComplete) << summary.reason;
  EXPECT_EQ(summary.frames, 1u);
}

class EveryVersion : public testing::TestWithParam<uint64_t> {};

TEST_P(EveryVersion, IsRead) {
  TraceBuilder trace(GetParam());
  trace.make_current(3, 100);
  trace.viewport(10, 20);
  Bytes enumeration = {0x09, 0};
  if (GetParam() >= 3) append(enumeration, {1});
  append_text(enumeration, "GL_ONE");
  append(enumeration, {0x04, 1});
  const Bytes again = GetParam() >= 3 ? Bytes{0x09, 0, 0x04, 1} : Bytes{0x09, 0};
  if (GetParam() >= 3) append(enumeration, {0x04, 1});
  trace.call("glEnable", {enumeration, again});
  trace.swap(3);
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kComplete) << summary.reason;
  EXPECT_EQ(summary.version, GetParam());
  EXPECT_EQ(summary.calls, 4u);
  EXPECT_EQ(summary.frames, 1u);
  ASSERT_EQ(summary.surfaces.size(), 1u);
  EXPECT_EQ(summary.surfaces[0].width, 10u);
}
INSTANTIATE_TEST_SUITE_P(Versions, EveryVersion, testing::Range<uint64_t>(0, 7));

TEST(TraceSummary, ReadsGzipContainers) {
  TraceBuilder trace;
  trace.swap(3);
  Bytes file(1000);
  z_stream stream{};
  ASSERT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = const_cast<uint8_t*>(trace.stream().data());
  stream.avail_in = static_cast<uInt>(trace.stream().size());
  stream.next_out = file.data();
  stream.avail_out = static_cast<uInt>(file.size());
  ASSERT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  file.resize(stream.total_out);
  deflateEnd(&stream);
  EXPECT_EQ(summary_of(file).frames, 1u);
  EXPECT_EQ(summary_of(file).container, "gzip");
  file.resize(file.size() - 12);  // the last bytes of the data and the checksum
  EXPECT_EQ(summary_of(file).state, TraceState::kTruncated);
}

TEST(TraceSummary, OfATraceWithoutFramesIsNoError) {
  TraceBuilder trace;
  trace.call("eglInitialize", {pointer(1)}, number(1));
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kComplete);
  EXPECT_EQ(summary.frames, 0u);
  EXPECT_EQ(summary.api, TraceApi::kEgl);
}

TEST(TraceSummary, CountsASwapThatNeverReturnedAsARetracerRepeatsIt) {
  TraceBuilder trace;
  trace.swap(3);
  trace.enter("eglSwapBuffers", {pointer(1), pointer(3)});
  const TraceSummary summary = summary_of(trace.file());
  EXPECT_EQ(summary.state, TraceState::kComplete);
  EXPECT_EQ(summary.frames, 2u);
  EXPECT_EQ(summary.open_calls, 1u);
}

}  // namespace
}  // namespace tilepress
