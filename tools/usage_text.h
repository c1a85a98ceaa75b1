// Usage text: what a mistake on the command line or in a --config file is called, with the way out.
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>
#include <string_view>

namespace tilepress {

/// The file of --config: its path, and the line of each key that sets an option.
struct ConfigLines {
  std::string path;
  std::map<std::string, unsigned> lines;

  /// "FILE: line 3: "; without the line if the key has none.
  std::string at(const std::string& key) const;
};

/// Returns the long names of the app's options, such as "--tile".
std::vector<std::string> option_names(const CLI::App& app);

/// Returns "unknown option 'X' (did you mean 'Y'?)" or "unexpected argument 'X' (see tilepress VERB --help)".
std::string unexpected_text(const CLI::App& app, const std::string& word);

/// Returns CLI11's complaint as one line that names the option, the value and the way out. A value that came from
/// the configuration file is named with file and line.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error, const ConfigLines& config);

}  // namespace tilepress
