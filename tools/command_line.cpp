// Command line: CLI11 with one-line errors and exit status 2.
#include "command_line.h"

// App.hpp declares what verbs use. CLI.hpp also defines formatters and configuration files, in this file alone:
// its code takes longer to compile than a verb.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <memory>

#include "toml_text.h"
#include "usage_text.h"

namespace tilepress {
namespace {

std::string scalar_text(const toml::node& node, const std::string& key) {
  if (auto text = node.value<std::string>(); node.is_string()) return *text;
  if (auto flag = node.value<bool>(); node.is_boolean()) return *flag ? "true" : "false";
  if (auto number = node.value<int64_t>(); node.is_integer()) return std::to_string(*number);
  if (auto number = node.value<double>(); node.is_floating_point()) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << *number;
    return text.str();
  }
  throw CLI::ConfigError(
      at_line(node, key + ": must be text, a number, true, false, or a list of these").text);
}

/// Reads top-level keys as long option names: strings, numbers, booleans, and arrays for repeatable options.
class TomlConfig : public CLI::Config {
 public:
  explicit TomlConfig(CLI::App& app) : app_(app) {}
  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return {}; }
  /// Throws CLI::ConfigError, which names the line.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    config_.path = app_.get_config_ptr()->as<std::string>();
    const auto table = parse_toml([&] { return toml::parse(input); });
    if (!table) throw CLI::ConfigError(table.error().text);
    std::vector<CLI::ConfigItem> found;
    for (const auto& [key_node, node] : *table) {
      const std::string key(key_node.str());
      // The command line was read before. An option that it sets takes nothing from here.
      const CLI::Option* option = app_.get_option_no_throw("--" + key);
      if (option == nullptr || option->empty()) config_.lines[key] = node.source().begin.line;
      CLI::ConfigItem item;
      item.name = key;
      if (const toml::array* list = node.as_array()) {
        for (const toml::node& element : *list) item.inputs.push_back(scalar_text(element, key));
      } else {
        item.inputs.push_back(scalar_text(node, key));
      }
      found.push_back(std::move(item));
    }
    return found;
  }
  const ConfigLines& lines() const { return config_; }

 private:
  CLI::App& app_;
  mutable ConfigLines config_;  // CLI11 reads files through const functions
};

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
  app.name(std::string("tilepress ") + argv[0]);
  app.set_config("--config", "", "Take options from a TOML file, by their long names")->type_name("FILE");
  const auto config = std::make_shared<TomlConfig>(app);
  app.config_formatter(config);
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.get_formatter()->column_width(34);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    return fail(kExitUsage, usage_text(app, error, config->lines()));
  }
  return std::nullopt;
}

std::optional<int> parse_launch_line(CLI::App& app, int argc, char** argv,
                                     std::vector<std::string>& program) {
  app.get_formatter()->label("OPTIONS", "OPTIONS] -- PROGRAM [ARGS...");  // CLI11 adds the outer brackets
  app.prefix_command();
  int own = 1;
  while (own < argc && std::strcmp(argv[own], "--") != 0) ++own;
  if (auto status = parse_command_line(app, own, argv)) return status;
  program = app.remaining();
  const auto refuse = [&app](const std::string& word) { return fail(kExitUsage, unexpected_text(app, word)); };
  if (own < argc && !program.empty()) return refuse(program.front());
  for (int i = own + 1; i < argc; ++i) program.emplace_back(argv[i]);
  if (program.empty())
    return fail(kExitUsage, std::string("no program given (see tilepress ") + argv[0] + " --help)");
  if (own == argc && program.front().starts_with("-")) return refuse(program.front());
  return std::nullopt;
}

}  // namespace tilepress
