// Shim log: what reaches the file, and that nothing reaches the program's streams.
#include "interposer/engine/shim_log.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tilepress {
namespace {

class ShimLogTest : public ::testing::Test {
 protected:
  ShimLogTest() {
    char name[] = "/tmp/shim_log_XXXXXX";
    folder_ = mkdtemp(name);
  }
  ~ShimLogTest() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ + "/log"; }
  std::string text() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string lines_of_level(const char* level) {
    std::filesystem::remove(path());
    ShimLog log(path(), level);
    log.error("error");
    log.warn("warn");
    log.info("info");
    log.debug("debug");
    return text();
  }
  std::string folder_;
};

TEST_F(ShimLogTest, HasTheLinesOfItsLevelAndAbove) {
  const std::string error = "tilepress: error\n", warn = error + "tilepress: warn\n",
                    info = warn + "tilepress: info\n", debug = info + "tilepress: debug\n";
  EXPECT_EQ(lines_of_level("off"), "");
  EXPECT_EQ(lines_of_level("error"), error);
  EXPECT_EQ(lines_of_level("warn"), warn);
  EXPECT_EQ(lines_of_level("info"), info);
  EXPECT_EQ(lines_of_level("debug"), debug);
  EXPECT_EQ(lines_of_level("trace"), debug);
  EXPECT_EQ(lines_of_level("loud"), warn);
}

TEST_F(ShimLogTest, WritesATextAsItIs) {
  ShimLog(path(), "warn").warn(std::string("{} {0:d} %v %n 100%"));
  EXPECT_EQ(text(), "tilepress: {} {0:d} %v %n 100%\n");
}

TEST_F(ShimLogTest, GoesOnWithAFileThatIsThere) {
  std::ofstream(path()) << "before\n";
  ShimLog(path(), "warn").warn("after");
  EXPECT_EQ(text(), "before\ntilepress: after\n");
}

TEST_F(ShimLogTest, SaysNothingOnTheProgramsStreamsWhereNoFileCanBeWritten) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  ShimLog("", "debug").error("lost");
  ShimLog(folder_ + "/missing/log", "debug").error("lost");
  ShimLog(folder_, "debug").error("lost");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ShimLogTest, WorksInAForkedChild) {
  ShimLog log(path(), "warn");
  log.warn("parent");
  const pid_t child = fork();
  if (child == 0) {
    log.warn("child");
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text(), "tilepress: parent\ntilepress: child\n");
}

TEST_F(ShimLogTest, KeepsNoDescriptorOpen) {
  ShimLog log(path(), "warn");
  const auto open_files = [] {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return std::distance(begin(all), end(all));
  };
  const auto before = open_files();
  for (int i = 0; i < 10; ++i) log.warn("line");
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace tilepress
