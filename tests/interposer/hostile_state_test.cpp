// Hostile state: the shim captures what a program presents, whatever state the program leaves, and keeps the
// state.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

struct Case {
  const char* api;
  std::map<std::string, std::string> environment;
  unsigned least_frames;  ///< the context has at least so many states; Mesa 22.3 has more
  bool with_alpha = true;
};

std::vector<Case> cases() {
  const std::pair<std::string, std::string> in_context = {"TILEPRESS_READBACK", "in-context"};
  return {
      {"glx", {}, 34, false},
      {"glx", {in_context, {"MESA_GL_VERSION_OVERRIDE", "2.1"}}, 30, false},
      {"gl", {{"TILEPRESS_READBACK", "sync"}}, 34},
      {"core", {in_context}, 19},
      {"es1", {in_context}, 4},
      {"es2", {in_context, {"MESA_GLES_VERSION_OVERRIDE", "2.0"}}, 8},
      {"es3", {in_context}, 11},
      {"osmesa", {}, 34},
      {"osmesa-core", {}, 19},
  };
}

/// Takes the lines "frame 7 RED_SCALE" out of `out` and returns the names by frame. Any other line is a
/// fault.
std::vector<std::string> states_of(std::string& out) {
  std::istringstream lines(out);
  std::vector<std::string> states;
  std::string rest, line;
  std::getline(lines, line);  // the version
  while (std::getline(lines, line)) {
    const std::string head = "frame " + std::to_string(states.size()) + " ";
    if (line.compare(0, head.size(), head) == 0)
      states.push_back(line.substr(head.size()));
    else
      rest += line + "\n";
  }
  out = rest;
  return states;
}

TEST(HostileState, ReachesNoPixelAndStaysAsTheProgramSetIt) {
  for (const Case& now : cases()) {
    SCOPED_TRACE(now.api);
    ShimTest test;
    std::map<std::string, std::string> environment = now.environment;
    if (std::strcmp(now.api, "glx") == 0) environment["DISPLAY"] = own_display();
    ShimRun run = test.run({TILEPRESS_HOSTILE_STATE, now.api}, environment);
    EXPECT_TRUE(run.process.exited_with(0)) << run.process.out;
    const std::vector<std::string> states = states_of(run.process.out);
    EXPECT_EQ(run.process.out, "");
    EXPECT_GE(states.size(), now.least_frames);
    for (unsigned frame = 0; frame < states.size(); ++frame)
      EXPECT_TRUE(test.dump(0, frame) == expected_picture(frame, 33, 21, now.with_alpha)) << states[frame];
  }
}

TEST(HostileState, ReachesNoPixelOfAFramebufferObject) {
  for (const char* api : {"gl", "core", "es3"}) {
    SCOPED_TRACE(api);
    ShimTest test;
    ShimRun run = test.run({TILEPRESS_HOSTILE_STATE, api, "object"}, {{"TILEPRESS_TRIGGER", "finish"}});
    EXPECT_TRUE(run.process.exited_with(0)) << run.process.out;
    const std::vector<std::string> states = states_of(run.process.out);
    EXPECT_EQ(run.process.out, "");
    EXPECT_GE(states.size(), 11u);
    for (unsigned frame = 0; frame < states.size(); ++frame)
      EXPECT_TRUE(test.dump(0, frame) == expected_picture(frame, 33, 21, true)) << states[frame];
  }
}

/// Setters would go into the program's display list. Such a frame is read in a private context, or not at
/// all.
TEST(HostileState, PutsNothingIntoADisplayList) {
  for (const char* readback : {"auto", "in-context"}) {
    ShimTest test;
    const ShimRun run = test.run({TILEPRESS_HOSTILE_STATE, "glx", "list"},
                                 {{"DISPLAY", own_display()}, {"TILEPRESS_READBACK", readback}});
    EXPECT_TRUE(run.process.exited_with(0));
    const std::string scale = "red scale after the list: 0.75\n";
    EXPECT_EQ(run.process.out.substr(run.process.out.find('\n') + 1), scale + scale);
    const bool anywhere = std::strcmp(readback, "auto") == 0;
    EXPECT_TRUE(test.dump(0, 0) == expected_picture(0, 33, 21, false));
    EXPECT_TRUE(test.dump(0, 1) == (anywhere ? expected_picture(1, 33, 21, false) : std::vector<uint8_t>()));
    ASSERT_EQ(run.runs.size(), 1u) << run.log;
    EXPECT_EQ(run.runs[0].json_number("not_captured"), anywhere ? 0 : 1);
  }
}

}  // namespace
}  // namespace tilepress::testing
