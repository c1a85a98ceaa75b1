// Command line: exit statuses, and CLI11 parsing that ends with one of them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "streams/messages.h"

namespace tilepress {

/// Exit statuses (spec §12).
constexpr int kExitDone = 0;
constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr int kExitNothingCaptured = 3;
constexpr int kExitLauncherFailed = 125;
constexpr int kExitNotExecutable = 126;
constexpr int kExitNotFound = 127;

/// Parses argv ([0] is the verb). Returns the exit status if the verb must stop here: help shown (0), or a
/// usage error, told in one line (2). Also gives the verb `--config FILE.toml`: the options under their long
/// names; what the command line says wins.
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

}  // namespace tilepress
