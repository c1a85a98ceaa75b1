// Read drawable: the presented surface is captured, also where the context reads from another one. That one,
// and everything the program can query, is as without the shim.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

using Environment = std::map<std::string, std::string>;

/// Expects three frames of the first surface with the pictures from `first` on, or none if `size` is 0.
void expect_frames(Road road, const char* api, const char* scene, Environment environment, unsigned step,
                   unsigned first, int width, int height) {
  SCOPED_TRACE(std::string(api) + " " + scene + " " + environment["TILEPRESS_READBACK"]);
  environment.emplace("DISPLAY", own_display());
  const std::vector<std::string> command = {TILEPRESS_READ_DRAWABLE, api, scene};
  Environment bare = environment;
  bare["LD_PRELOAD"] = "";
  const ProcessResult without = run_process(command, bare);
  ShimTest test(road);
  const ShimRun run = test.run(command, environment);
  EXPECT_TRUE(without.exited_with(0)) << without.err;
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, without.out);
  const bool alpha = std::string(api).rfind("x-", 0) != 0;
  for (unsigned frame = 0; frame < 3; ++frame)
    EXPECT_TRUE(
        test.dump(0, frame) ==
        (width == 0 ? std::vector<uint8_t>() : expected_picture(first + step * frame, width, height, alpha)))
        << "frame " << frame << "\n"
        << run.log;
}

void expect_presented(Road road, const char* api, const char* scene, const Environment& environment = {}) {
  expect_frames(road, api, scene, environment, 1, 0, 33, 21);
}

TEST(ReadDrawable, IsNotWhatIsCaptured) {
  for (const char* api : {"glx", "glxwindow", "glxpixmap", "gl", "es1", "es2", "es3", "x-gl", "x-es3"}) {
    expect_presented(Road::kPreload, api, "smaller");
    expect_presented(Road::kPreload, api, "larger", {{"TILEPRESS_READBACK", "in-context"}});
  }
  for (const char* api : {"glx", "glxwindow"}) expect_presented(Road::kPreload, api, "config");
}

TEST(ReadDrawable, IsNotWhatIsCapturedOnTheSecondRoad) {
  for (const char* api : {"glx", "gl", "x-es3"}) expect_presented(Road::kGlvnd, api, "larger");
}

TEST(ReadDrawable, IsNotWhatIsCapturedInAPrivateContext) {
  for (const char* api : {"glx", "glxwindow", "x-gl"})
    expect_presented(Road::kPreload, api, "smaller", {{"TILEPRESS_READBACK", "async"}});
}

TEST(ReadDrawable, IsCapturedWhereItIsPresented) {
  for (const char* api : {"glx", "glxwindow"}) expect_frames(Road::kPreload, api, "read", {}, 0, 50, 40, 40);
}

TEST(ReadDrawable, IsCapturedBeforeGlReadPixelsAndTheOtherBeforeGlFinish) {
  for (const char* api : {"glx", "glxpbuffer", "gl", "es3"}) {
    expect_frames(Road::kPreload, api, "readpixels", {{"TILEPRESS_TRIGGER", "readpixels"}}, 0, 50, 40, 40);
    expect_presented(Road::kPreload, api, "finish", {{"TILEPRESS_TRIGGER", "finish"}});
  }
  expect_presented(Road::kPreload, "glx", "front", {{"TILEPRESS_TRIGGER", "finish"}});
}

/// The shim could not come back after making another surface current. It takes no frame and does no harm.
TEST(ReadDrawable, ThatIsDestroyedStaysCurrent) {
  for (const char* api : {"glx", "glxwindow", "gl", "es2", "x-es3"})
    expect_frames(Road::kPreload, api, "destroyed", {}, 0, 0, 0, 0);
}

TEST(ReadDrawable, LetsAWindowThatIsResizedAfterDrawingShowWhatWasDrawn) {
  for (const char* api : {"glx", "glxwindow", "x-gl", "x-es3"}) {
    SCOPED_TRACE(api);
    const std::vector<std::string> command = {TILEPRESS_READ_DRAWABLE, api, "resized"};
    const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
    ShimTest test;
    const ShimRun run = test.run(command, {{"DISPLAY", own_display()}});
    EXPECT_TRUE(run.process.exited_with(0));
    EXPECT_EQ(run.process.out, without.out);
    ASSERT_EQ(run.runs.size(), 1u) << run.log;
    EXPECT_EQ(run.runs[0].json_number("captured"), 3) << run.log;
  }
}

TEST(ReadDrawable, MayBelongToAThreadThatPresentsNothing) {
  for (const char* api : {"glx", "gl", "es3"})
    expect_frames(Road::kPreload, api, "elsewhere", {}, 0, 0, 0, 0);
}

}  // namespace
}  // namespace tilepress::testing
