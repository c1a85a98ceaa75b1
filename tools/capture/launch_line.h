// Launch line: the command line of a verb that starts a program, `VERB [OPTIONS] -- PROGRAM [ARGS...]`.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace tilepress {

/// Parses the verb's own options with `app` and puts everything after the first "--" into `program`. Without
/// a "--", the program begins at the first word that is not an option. Returns the exit status if the verb
/// must stop here.
std::optional<int> parse_launch_line(CLI::App& app, int argc, char** argv, std::vector<std::string>& program);

}  // namespace tilepress
