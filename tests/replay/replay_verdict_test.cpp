// Replay verdicts: what is said of a replay that captured all, some or none of the frames asked for.
#include "replay_verdict.h"

#include <gtest/gtest.h>

namespace tilepress {
namespace {

class ReplayVerdict : public testing::Test {
 protected:
  ReplayVerdict() {
    trace_.frames = 10;
    outcome_.exit_status = 0;
    outcome_.seconds = 2.5;
  }
  void capture(uint64_t frames) {
    run_.frames.resize(frames);
    run_.counts.seen = run_.counts.captured = frames;
  }
  ReplayResult judged(uint64_t frames_wanted = 10, bool with_run = true) const {
    return judge({trace_, options_, frames_wanted, std::chrono::seconds(300), retracer_, outcome_,
                  with_run ? &run_ : nullptr});
  }

  TraceSummary trace_;
  RunOptions options_;
  AttemptOutcome outcome_;
  RunRecord run_;
  const std::string retracer_ = "eglretrace";
};

TEST_F(ReplayVerdict, OfEveryFrameIsDone) {
  capture(10);
  const ReplayResult result = judged();
  EXPECT_EQ(result.status, ReplayStatus::kDone);
  EXPECT_EQ(result.reason, "");
  EXPECT_EQ(result.frames_in_trace, 10u);
  EXPECT_EQ(result.frames_wanted, 10u);
  EXPECT_EQ(result.frames_captured, 10u);
  EXPECT_EQ(result.seconds, 2.5);
}

TEST_F(ReplayVerdict, OfSomeFramesSaysWhatHappenedToTheOthers) {
  capture(4);
  run_.counts.unsupported = 3;
  run_.counts.dropped = 2;
  run_.counts.not_captured = 1;
  outcome_.last_lines = {"out of memory"};
  const ReplayResult result = judged();
  EXPECT_EQ(result.status, ReplayStatus::kFailed);
  EXPECT_EQ(result.reason,
            "captured 4 of 10 frames: 3 in an unsupported format, 1 could not be read back, 2 dropped (queue "
            "full)");
  EXPECT_EQ(result.retracer_lines, outcome_.last_lines);
}

TEST_F(ReplayVerdict, OfNoFrameSaysWhatTheRetracerDid) {
  EXPECT_EQ(judged(10, false).status, ReplayStatus::kNothingCaptured);
  EXPECT_EQ(judged(10, false).reason,
            "no frame captured of 10 frames: eglretrace asked for no presenting function");
  outcome_.seen = {"eglretrace eglSwapBuffers dlsym"};
  EXPECT_EQ(judged(10, false).reason, "no frame captured of 10 frames: eglretrace presented nothing");
  EXPECT_EQ(judged(1, true).reason, "no frame captured of 1 frame: eglretrace presented 0 frames");
  outcome_.hung = true;
  EXPECT_EQ(judged(10, false).reason,
            "no frame captured of 10 frames: eglretrace showed no frame for 300 s and was ended");
}

TEST_F(ReplayVerdict, AfterASignalIsInterruptedUnlessEveryFrameWasCaptured) {
  outcome_.interrupted = true;
  capture(4);
  EXPECT_EQ(judged().status, ReplayStatus::kInterrupted);
  EXPECT_EQ(judged().reason, "stopped after 4 of 10 frames");
  capture(10);
  EXPECT_EQ(judged().status, ReplayStatus::kDone);
  options_.triggers = kTriggerFlush;  // then more frames may have been to come
  EXPECT_EQ(judged().status, ReplayStatus::kInterrupted);
}

TEST_F(ReplayVerdict, OfARetracerWithoutGlLibrariesNamesTheirPackages) {
  outcome_.exit_status = 1;
  outcome_.last_lines = {"error: unavailable function eglGetProcAddress"};
  EXPECT_EQ(
      judged(10, false).reason,
      "no frame captured of 10 frames: eglretrace ended with status 1 (it loads libEGL.so and libGLESv2.so: "
      "Debian packages libegl-dev and libgles-dev)");
}

TEST_F(ReplayVerdict, OfACutTraceOrAWrongDecodingIsAFailureThoughEveryFrameIsThere) {
  capture(10);
  trace_.state = TraceState::kTruncated;
  trace_.reason = "the last chunk is cut off";
  EXPECT_EQ(judged().reason,
            "truncated after 10 frames: the last chunk is cut off; the frames before were captured");
  run_.frames[3].schemes.resize(1);
  run_.frames[3].schemes[0].mismatched_blocks = 1;
  EXPECT_EQ(judged().status, ReplayStatus::kFailed);
  EXPECT_EQ(judged().reason, "--verify: 1 block decoded to other pixels");
}

TEST_F(ReplayVerdict, TakesWhatCameOfTriggersAndOfWindowsThatChangeTheirShape) {
  options_.triggers = kTriggerFlush;
  capture(23);
  EXPECT_EQ(judged().frames_wanted, 23u);
  EXPECT_EQ(judged().status, ReplayStatus::kDone);
  options_.triggers = 0;
  capture(6);  // five were asked for, and the second surface of the window gave one more
  run_.counts.seen = 10;
  run_.counts.skipped = 4;
  EXPECT_EQ(judged(5).status, ReplayStatus::kDone);
  EXPECT_EQ(judged(5).frames_wanted, 6u);
  run_.counts.skipped = 3;
  EXPECT_EQ(judged(5).status, ReplayStatus::kFailed);
}

}  // namespace
}  // namespace tilepress
