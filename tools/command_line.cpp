// Command line: CLI11 with one-line errors and exit status 2.
#include "command_line.h"

#include <cstdio>
#include <memory>
#include <string>

#include "toml_config.h"

namespace tilepress {
namespace {

/// What CLI11 says, or a clearer text where there is one.
std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto extras = app.remaining();
    if (!extras.empty())
      return (extras.front().starts_with("-") ? "unknown option '" : "unexpected argument '") +
             extras.front() + "'";
  }
  std::string text = error.what();
  if (const std::string prefix = "INI was not able to parse "; text.starts_with(prefix))
    text = "--config: unknown option '" + text.substr(prefix.size()) + "'";
  return text;
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
  app.name(std::string("tilepress ") + argv[0]);
  app.set_config("--config", "", "Take options from a TOML file, by their long names")->type_name("FILE");
  app.config_formatter(std::make_shared<TomlConfig>());
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.get_formatter()->column_width(34);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    return fail(kExitUsage, describe(app, error));
  }
  return std::nullopt;
}

}  // namespace tilepress
