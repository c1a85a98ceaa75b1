// TOML configuration: toml++ reads the file, CLI11 checks the options.
#include "toml_config.h"

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

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
  throw CLI::ConfigError("config: " + key + ": must be text, a number, true, false, or a list of these");
}

}  // namespace

std::vector<CLI::ConfigItem> TomlConfig::from_config(std::istream& input) const {
  toml::table table;
  try {
    table = toml::parse(input);
  } catch (const toml::parse_error& error) {
    throw CLI::ConfigError("config: line " + std::to_string(error.source().begin.line) + ": " +
                           std::string(error.description()));
  }
  std::vector<CLI::ConfigItem> found;
  for (const auto& [key_node, node] : table) {
    const std::string key(key_node.str());
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

}  // namespace tilepress
