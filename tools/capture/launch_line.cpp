// Launch line: CLI11 sees only the words before "--".
#include "capture/launch_line.h"

#include <cstring>

namespace tilepress {

std::optional<int> parse_launch_line(CLI::App& app, int argc, char** argv,
                                     std::vector<std::string>& program) {
  app.get_formatter()->label("OPTIONS", "OPTIONS] -- PROGRAM [ARGS...");  // CLI11 adds the outer brackets
  app.prefix_command();
  int own = 1;
  while (own < argc && std::strcmp(argv[own], "--") != 0) ++own;
  if (auto status = parse_command_line(app, own, argv)) return status;
  program = app.remaining();
  const auto refuse = [](const std::string& word) {
    return fail(kExitUsage,
                (word.starts_with("-") ? "unknown option '" : "unexpected argument '") + word + "'");
  };
  if (own < argc && !program.empty()) return refuse(program.front());
  for (int i = own + 1; i < argc; ++i) program.emplace_back(argv[i]);
  if (program.empty())
    return fail(kExitUsage, std::string("no program given (see tilepress ") + argv[0] + " --help)");
  if (own == argc && program.front().starts_with("-")) return refuse(program.front());
  return std::nullopt;
}

}  // namespace tilepress
