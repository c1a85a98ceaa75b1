// Tests of cached renderings: a trace is rendered once, and the cache holds what a replay captures.
#include "study/cache/cached_rendering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include "made_frames.h"
#include "streams/messages.h"
#include "study/cache/cache_key.h"
#include "study/cache/frame_cache.h"

namespace tilepress {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kTrace = std::string(TILEPRESS_TEST_TRACES) + "/glmark2-desktop-egl.trace";
const std::atomic<int> kNeverStops{0};

ReplayInput first_frames(const std::string& frames) {
  ReplayInput input;
  input.path = kTrace;
  input.name = "desktop";
  input.frames = *FrameSet::parse(frames);
  return input;
}

RenderOptions options_for(const TestFolder& folder) {
  RenderOptions options;
  options.cache_folder = folder.file("cache");
  options.shim = TILEPRESS_TEST_SHIM;
  return options;
}

CachedRendering expect_rendering(const ReplayInput& input, const RenderOptions& options) {
  const auto done = find_or_render(input, options, kNeverStops);
  EXPECT_TRUE(done) << done.error().text;
  return done ? *done : CachedRendering{};
}

/// The raw frames that a replay of the same trace dumps, by name.
std::map<std::string, std::string> dumped(const ReplayInput& input, const TestFolder& folder) {
  ReplayOptions replay;
  replay.run.output = folder.file("replay");
  replay.run.dump_frames_every = 1;
  replay.shim = TILEPRESS_TEST_SHIM;
  TraceReplay replayed(input, replay);
  EXPECT_TRUE(replayed.prepare(TraceReading::kBefore));
  replayed.run(kNeverStops);
  EXPECT_EQ(replayed.result().status, ReplayStatus::kDone) << replayed.result().reason;
  std::map<std::string, std::string> frames;
  for (const auto& entry : std::filesystem::directory_iterator(replayed.result().run.path + "/frames"))
    frames[entry.path().stem()] = bytes_of_file(entry.path());
  return frames;
}

TEST(CachedRendering, HoldsWhatAReplayCapturesAndIsRenderedOnce) {
  const TestFolder folder;
  const ReplayInput input = first_frames("1-3");
  const RenderOptions options = options_for(folder);
  EXPECT_FALSE(find_rendered(input, options)->has_value());
  const CachedRendering rendering = expect_rendering(input, options);
  EXPECT_TRUE(rendering.rendered);
  EXPECT_EQ(rendering.reason, "");

  FrameCacheReader reader;
  ASSERT_TRUE(reader.open(rendering.path));
  EXPECT_EQ(reader.origin().expected_frames, 3u);
  EXPECT_EQ(reader.origin().frame_set, "1-3");
  EXPECT_THAT(reader.origin().input, StartsWith("/"));
  const auto frames = dumped(input, folder);
  ASSERT_EQ(reader.frame_count(), frames.size());
  ASSERT_EQ(frames.size(), 3u);
  for (uint64_t i = 0; i < 3; ++i) {
    std::vector<std::byte> pixels;
    ASSERT_TRUE(reader.read(i, pixels));
    const std::string name = "0-00000" + std::to_string(i + 1);
    EXPECT_EQ(reader.header(i).frame, i + 1);
    EXPECT_EQ(reader.header(i).warmup, i == 0);
    EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), std::as_bytes(std::span(frames.at(name))).begin(),
                           std::as_bytes(std::span(frames.at(name))).end()));
  }

  const CachedRendering again = expect_rendering(input, options);
  EXPECT_FALSE(again.rendered);
  EXPECT_EQ(again.path, rendering.path);
  EXPECT_EQ(**find_rendered(input, options), rendering.path);
  // Nothing but the file is left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(options.cache_folder), {}), 1);
}

TEST(CachedRendering, OfTwoThatAskAtTheSameTimeOneRenders) {
  const TestFolder folder;
  const ReplayInput input = first_frames("0");
  const RenderOptions options = options_for(folder);
  probe_renderer();
  std::vector<CachedRendering> done(2);
  std::vector<std::thread> threads;
  for (CachedRendering& each : done) threads.emplace_back([&] { each = expect_rendering(input, options); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done[0].rendered + done[1].rendered, 1);
  EXPECT_EQ(done[0].path, done[1].path);
}

TEST(CachedRendering, ReplacesWhatIsNoWholeCacheOfThisKey) {
  const TestFolder folder;
  const ReplayInput input = first_frames("0");
  const RenderOptions options = options_for(folder);
  const CachedRendering first = expect_rendering(input, options);
  const std::string good = bytes_of_file(first.path);
  write_cache(folder.file("foreign"), make_frames(Content::kStill, 0, 1, 8, 8));
  const std::pair<std::string, const char*> kBad[] = {
      {good.substr(0, good.size() / 2), ": is torn or no whole frame cache; rendered again\n"},
      {bytes_of_file(folder.file("foreign")),
       ": holds the frames of another trace or renderer; rendered again\n"},
  };
  for (const auto& [bytes, line] : kBad) {
    write_bytes(first.path, bytes);
    EXPECT_FALSE(find_rendered(input, options)->has_value());
    testing::internal::CaptureStderr();
    open_messages();
    EXPECT_TRUE(expect_rendering(input, options).rendered);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr(first.path + line));
    FrameCacheReader reader;
    EXPECT_TRUE(reader.open(first.path));
  }
}

TEST(CachedRendering, KeyIsThatOfTraceRangeAndOptions) {
  RenderOptions options;
  const auto key_of = [&](const std::string& frames) {
    return cache_key(first_frames(frames), options)->key;
  };
  const std::string key = key_of("0-1");
  EXPECT_EQ(key.size(), 64u);
  EXPECT_EQ(key_of("0-1"), key);
  EXPECT_NE(key_of("0-2"), key);
  options.display = ReplayDisplay::kXvfb;
  EXPECT_NE(key_of("0-1"), key);
}

TEST(CachedRendering, SaysWhyATraceCannotBeRendered) {
  const TestFolder folder;
  ReplayInput input;
  input.path = folder.file("none.trace");
  const auto missing = find_or_render(input, options_for(folder), kNeverStops);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text, input.path + ": No such file or directory");
  write_bytes(input.path, "not a trace");
  const auto foreign = find_or_render(input, options_for(folder), kNeverStops);
  ASSERT_FALSE(foreign);
  EXPECT_THAT(foreign.error().text, StartsWith(input.path + ": "));
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("cache")));
  input = first_frames("0");
  input.sha256 = std::string(64, '0');
  const auto other = find_or_render(input, options_for(folder), kNeverStops);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().text, HasSubstr("as the manifest says"));
}

TEST(CachedRendering, EndsOnASignalAndLeavesNothing) {
  const TestFolder folder;
  std::atomic<int> stop{0};
  RenderOptions options = options_for(folder);
  options.progress = [&](uint64_t, std::optional<uint64_t>) { stop = 15; };
  const auto done = find_or_render(first_frames("0-60"), options, stop);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().text, kTrace + ": interrupted");
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("cache")));
}

}  // namespace
}  // namespace tilepress
