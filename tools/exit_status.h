// Exit status: what the command returns to its caller.
#pragma once

namespace tilepress {

constexpr int kExitDone = 0;
constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr int kExitNothingCaptured = 3;
constexpr int kExitLauncherFailed = 125;
constexpr int kExitNotExecutable = 126;
constexpr int kExitNotFound = 127;

}  // namespace tilepress
