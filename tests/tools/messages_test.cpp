// Messages: what reaches standard error, byte for byte.
#include "streams/messages.h"

#include <gtest/gtest.h>

#include <functional>

namespace tilepress {
namespace {

std::string standard_error_of(const std::function<void()>& action) {
  testing::internal::CaptureStderr();
  action();
  return testing::internal::GetCapturedStderr();
}

TEST(Message, IsOneLineWithoutControlCharacters) {
  EXPECT_EQ(standard_error_of([] { EXPECT_EQ(fail(2, "x.png: {} is\nodd\x1b[2J\n\n"), 2); }),
            "tilepress: x.png: {} is odd?[2J\n");
  EXPECT_EQ(standard_error_of([] {
              fail(1, Error{ErrorKind::kFile, "caf\xc3\xa9: missing"});
            }),
            "tilepress: caf\xc3\xa9: missing\n");
}

TEST(Message, IsHiddenBelowTheLevelUnlessItIsAnError) {
  const auto say_all = [] {
    say(MessageLevel::kInfo, "info");
    say(MessageLevel::kWarning, "warning");
    say(MessageLevel::kError, "error");
  };
  EXPECT_EQ(standard_error_of(say_all), "tilepress: warning\ntilepress: error\n");
  set_message_level("info");
  EXPECT_EQ(standard_error_of(say_all), "tilepress: info\ntilepress: warning\ntilepress: error\n");
  set_message_level("off");
  EXPECT_EQ(standard_error_of(say_all), "tilepress: error\n");
  set_message_level("warn");
}

TEST(Message, TakesTheProgressLineAway) {
  EXPECT_EQ(standard_error_of([] {
              show_progress("1/3");
              show_progress("2/3");
              fail(1, "stop");
              show("  table\n");
            }),
            "\r1/3\033[K\r2/3\033[K\r\033[Ktilepress: stop\n  table\n");
}

}  // namespace
}  // namespace tilepress
