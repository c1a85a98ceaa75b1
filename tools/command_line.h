// Command line: CLI11 parsing that ends with an exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "exit_status.h"
#include "streams/messages.h"

namespace tilepress {

/// Parses argv ([0] is the verb). Returns the exit status if the verb must stop here: help shown (0), or a
/// usage error, told in one line (2). Also gives the verb `--config FILE.toml`: the options under their long
/// names; what the command line says wins.
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

}  // namespace tilepress
