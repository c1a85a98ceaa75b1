// The worker's pace: when it lets the program go first, and the thread on which it does.
#include "interposer/engine/worker/yielding_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>

#include <stdexcept>
#include <thread>

namespace tilepress {
namespace {

constexpr uint64_t kMs = 1'000'000;

/// Frames that are not yielded for, before the pace yields again.
uint32_t rest_of(WorkerPace& pace) {
  uint32_t frames = 0;
  for (; !pace.yields(1, 3) && frames <= 2 * WorkerPace::kLongestRest; ++frames) pace.hurried();
  return frames;
}

TEST(WorkerPace, YieldsWhileItKeepsUpAndHurriesWhenFramesPileUp) {
  const WorkerPace pace;
  EXPECT_TRUE(pace.yields(1, 3));
  EXPECT_FALSE(pace.yields(2, 3));
  EXPECT_FALSE(pace.yields(3, 3));
  EXPECT_TRUE(pace.yields(4, 8));
  EXPECT_FALSE(pace.yields(5, 8));
  EXPECT_TRUE(pace.yields(1, 1));
}

TEST(WorkerPace, RestsLongerEachTimeItWasStarvedUpToABound) {
  WorkerPace pace;
  uint32_t expected = WorkerPace::kFirstRest;
  for (int time = 0; time < 20; ++time) {
    pace.yielded(101 * kMs, 10 * kMs, true);
    EXPECT_EQ(rest_of(pace), expected) << time;
    expected = std::min(2 * expected, WorkerPace::kLongestRest);
  }
}

TEST(WorkerPace, GoesOnYieldingWhileNobodyWaitsOrTheWorkItselfIsLong) {
  WorkerPace pace;
  pace.yielded(500 * kMs, 10 * kMs, false);  // slow, but the program did not wait
  EXPECT_TRUE(pace.yields(1, 3));
  pace.yielded(100 * kMs, 10 * kMs, true);  // it did, for work that took as long as it has to
  EXPECT_TRUE(pace.yields(1, 3));
}

TEST(YieldingThread, WorksOnAThreadOfItsOwnOfTheIdleClassWithTheSignalsOfItsMaker) {
  sigset_t all, before;
  sigfillset(&all);
  ASSERT_EQ(pthread_sigmask(SIG_SETMASK, &all, &before), 0);
  const int own_class = sched_getscheduler(0);
  YieldingThread thread;
  std::thread::id first, second;
  int scheduler = -1;
  sigset_t mask;
  thread.run([&] { first = std::this_thread::get_id(); });
  thread.run([&] {
    second = std::this_thread::get_id();
    scheduler = sched_getscheduler(0);
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_NE(first, std::this_thread::get_id());
  EXPECT_EQ(first, second);
  EXPECT_EQ(scheduler, SCHED_IDLE);
  EXPECT_EQ(sched_getscheduler(0), own_class) << "the caller keeps its own";
  EXPECT_EQ(sigismember(&mask, SIGTERM), 1);
}

TEST(YieldingThread, TellsTheTimeOfItsWork) {
  YieldingThread thread;
  const YieldingThread::Turn turn =
      thread.run([] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); });
  EXPECT_GE(turn.wall_ns, 20 * kMs);
  EXPECT_GT(turn.cpu_ns, 0u);
  EXPECT_LT(turn.cpu_ns, turn.wall_ns);
}

TEST(YieldingThread, HandsWhatItsWorkThrowsToTheCallerAndGoesOn) {
  YieldingThread thread;
  EXPECT_THROW(thread.run([] { throw std::runtime_error("no room"); }), std::runtime_error);
  int done = 0;
  for (int i = 0; i < 1000; ++i) thread.run([&] { ++done; });
  EXPECT_EQ(done, 1000);
}

}  // namespace
}  // namespace tilepress
