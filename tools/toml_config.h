// TOML configuration: reads options for CLI11 from a TOML file.
#pragma once

#include <CLI/CLI.hpp>

namespace tilepress {

/// Reads top-level keys as long option names: strings, numbers, booleans, and arrays for repeatable options.
class TomlConfig : public CLI::Config {
 public:
  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return {}; }
  /// Throws CLI::ConfigError, which names the line or the key.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
};

}  // namespace tilepress
