// Run lock: whoever asks about a run learns whether it has a writer, whatever process that is.
#include "tilepress/run_lock.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "tilepress/run_directory.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

class RunLock : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "lock-XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    base_ = pattern;
    path_ = base_ + "/run";
    ASSERT_EQ(pipe(steps_), 0);
  }
  void TearDown() override {
    fs::remove_all(base_);
    if (writer_ <= 0) return;
    kill(writer_, SIGKILL);
    waitpid(writer_, nullptr, 0);
  }
  /// A process that makes the run, and waits for a signal once it has told `ended`.
  void start_writer(bool ended) {
    writer_ = fork();
    if (writer_ != 0) {
      char step;
      ASSERT_EQ(read(steps_[0], &step, 1), 1);
      return;
    }
    RunWriter writer;
    if (!writer.create(path_, RunInfo{}, RunOptions{})) _exit(1);
    if (ended) writer.program_has_ended();
    if (write(steps_[1], "x", 1) != 1) _exit(1);
    for (;;) pause();
  }
  void end_writer() {
    kill(writer_, SIGKILL);
    waitpid(writer_, nullptr, 0);
    writer_ = 0;
  }

  std::string base_, path_;
  int steps_[2] = {};
  pid_t writer_ = 0;
};

TEST_F(RunLock, IsHeldUntilTheWriterIsGoneEvenIfItIsKilled) {
  EXPECT_FALSE(run_is_written(path_));
  start_writer(false);
  EXPECT_TRUE(run_is_written(path_));
  EXPECT_TRUE(program_is_captured(path_));
  end_writer();
  EXPECT_FALSE(run_is_written(path_));
  EXPECT_FALSE(program_is_captured(path_));
}

TEST_F(RunLock, TellsAWriterWhoseProgramHasEndedFromARunningProgram) {
  start_writer(true);
  EXPECT_TRUE(run_is_written(path_));
  EXPECT_FALSE(program_is_captured(path_));
}

TEST_F(RunLock, IsNotWaitedForWhileTheProgramGoesOn) {
  start_writer(false);
  EXPECT_FALSE(wait_for_writer(path_, false));
}

TEST_F(RunLock, IsWaitedForWhenTheProgramHasEnded) {
  start_writer(true);
  const pid_t ender = fork();
  if (ender == 0) {
    usleep(100'000);
    kill(writer_, SIGKILL);
    _exit(0);
  }
  EXPECT_TRUE(wait_for_writer(path_, false));
  waitpid(ender, nullptr, 0);
}

TEST_F(RunLock, IsNotInheritedByAForkedChild) {
  RunWriter writer;
  ASSERT_TRUE(writer.create(path_, RunInfo{}, RunOptions{}));
  const pid_t asker = fork();
  if (asker == 0) _exit(run_is_written(path_) ? 7 : 1);  // another process than the writer's
  int status = 0;
  waitpid(asker, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

}  // namespace
}  // namespace tilepress
