// Command line: CLI11 parsing that ends with an exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "exit_status.h"
#include "streams/messages.h"

namespace tilepress {

/// Parses argv ([0] is the verb). Returns the exit status if the verb must stop: 0 after printing the help, 2
/// after printing a usage error. Also adds `--config FILE.toml`, which sets options by their long names. The
/// command line wins over the file.
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

}  // namespace tilepress
