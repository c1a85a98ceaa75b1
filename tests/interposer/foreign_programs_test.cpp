// Foreign programs: programs of sanitizers and of another C library start, print and end as without the shim.
#include <gtest/gtest.h>
#include <stdlib.h>

#include "expected_picture.h"
#include "shim_process.h"
#include "tilepress/shim_environment.h"

namespace tilepress::testing {
namespace {

std::string foreign(const std::string& name) {
  return std::string(TILEPRESS_FOREIGN_PROGRAMS) + "/" + name;
}

/// The part of the launcher's environment that a preloaded library needs.
std::map<std::string, std::string> launcher_environment(const char* library = TILEPRESS_PRELOAD) {
  std::map<std::string, std::string> added;
  EXPECT_TRUE(add_shim_environment(added, ShimRoad::kPreload, library));
  return added;
}

void expect_the_same(const std::vector<std::string>& command,
                     const std::map<std::string, std::string>& environment, int status) {
  const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}});
  EXPECT_TRUE(without.exited_with(status)) << command.back() << without.err;
  const ProcessResult with = run_process(command, environment);
  EXPECT_EQ(with.status, without.status) << command.back() << with.err;
  EXPECT_EQ(with.out, without.out) << command.back();
  EXPECT_EQ(with.err, without.err) << command.back();
}

class Sanitized : public ::testing::TestWithParam<const char*> {};

TEST_P(Sanitized, ThePictureIsCapturedAndTheProgramEndsAsEver) {
  const std::string program = foreign(GetParam());
  const std::vector<std::vector<std::string>> commands = {
      {program, "link", "3", "32", "24"},
      {"sh", "-c", "\"$0\" \"$@\"; exit $?", program, "link", "3", "32", "24"},
      // A script that replaces the options.
      {"sh", "-c", "ASAN_OPTIONS=verbosity=0 \"$0\" \"$@\"; exit $?", program, "link", "3", "32", "24"}};
  for (const auto& command : commands) {
    ShimTest test;
    const ShimRun run = test.run(command, launcher_environment());
    EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
    EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
    EXPECT_EQ(run.process.err, "");
    ASSERT_EQ(run.runs.size(), 1u) << run.log;
    EXPECT_EQ(run.runs[0].json_number("captured"), 3);
    EXPECT_EQ(test.dump(0, 2), expected_picture(2, 32, 24, true));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Sanitized,
                         ::testing::Values("gcc-address", "gcc-thread", "gcc-undefined", "gcc-leak",
                                           "clang-address", "clang-address-shared", "clang-thread",
                                           "clang-undefined"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(ForeignPrograms, AProgramOfTheMemorySanitizerRuns) {
  expect_the_same({foreign("clang-memory")}, launcher_environment(), 7);
}

TEST(ForeignPrograms, AReportAtExitStillDecidesTheStatus) {
  const std::vector<std::string> command = {foreign("race-and-exit")};
  const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}});
  const ProcessResult with = run_process(command, launcher_environment());
  EXPECT_TRUE(without.exited_with(66)) << without.err;
  EXPECT_TRUE(with.exited_with(66)) << with.err;
}

TEST(ForeignPrograms, DefaultOptionsOfTheProgramDoNotKeepAsanFromStarting) {
  expect_the_same({foreign("asan-own-options")}, launcher_environment(), 7);
}

TEST(ForeignPrograms, OptionsForAsanFromOutsideAreKept) {
  setenv("ASAN_OPTIONS", "exitcode=9", 1);
  EXPECT_EQ(launcher_environment()["ASAN_OPTIONS"], "verify_asan_link_order=0:exitcode=9");
  unsetenv("ASAN_OPTIONS");
}

TEST(ForeignPrograms, AProgramOfMuslRunsUnharmed) {
  for (const char* library : {TILEPRESS_PRELOAD, TILEPRESS_PRELOAD_GL})
    for (const char* end : {"return", "_exit", "_Exit"})
      expect_the_same({foreign("musl-hello"), end}, launcher_environment(library), 7);
}

TEST(ForeignPrograms, AHelperOfMuslDoesNotDisturbTheCapture) {
  ShimTest test;
  const ShimRun run = test.run({"sh", "-c", "\"$0\" > /dev/null; [ $? = 7 ] || exit 1; exec \"$@\"",
                                foreign("musl-hello"), TILEPRESS_EGL_LINKED, "link", "3", "32", "24"},
                               launcher_environment());
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].json_number("captured"), 3);
}

}  // namespace
}  // namespace tilepress::testing
