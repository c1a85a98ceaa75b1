// Run option parser: walks over the table of options.
#include "tilepress/run_options.h"

#include <algorithm>
#include <cstdlib>

#include "tilepress/plugin_library.h"
#include "tilepress/run_option_table.h"

namespace tilepress {

static Result<void> set_as(const std::string& subject, const RunOption& option, RunOptions& options,
                           std::string_view value) {
  auto set = option.text.set(option, options, value);
  if (set) return set;
  return Error{set.error().kind, subject + set.error().text};
}

Result<void> set_run_option(RunOptions& options, std::string_view name, std::string_view value) {
  const RunOption* option = find_run_option(name);
  if (option == nullptr) return Error{ErrorKind::kBadValue, std::string(name) + ": unknown option"};
  return set_as(std::string(name) + " ", *option, options, value);
}

std::map<std::string, std::string> to_environment(const RunOptions& options) {
  std::map<std::string, std::string> out;
  for (const RunOption& option : run_option_table()) out.emplace(option.variable, option.text.print(options));
  return out;
}

Result<void> from_environment(RunOptions& options) {
  for (const RunOption& option : run_option_table()) {
    const std::string variable(option.variable);
    const char* value = std::getenv(variable.c_str());
    if (value == nullptr || *value == '\0') continue;
    if (auto set = set_as(variable + "=", option, options, value); !set) return set;
  }
  return {};
}

std::string rows_fingerprint(const RunOptions& options) {
  std::string out;
  for (const RunOption& option : run_option_table()) {
    const std::string value = option.text.print(options);
    if (option.rows == RowsEffect::kNone ||
        (option.rows == RowsEffect::kUnlessDefault && value == option.text.print(RunOptions{})))
      continue;
    if (!out.empty()) out += ' ';
    if (option.rows != RowsEffect::kValue) out.append(option.name) += '=';
    out += value;
  }
  for (const PluginLibrary& library : loaded_plugins())
    if (std::ranges::any_of(options.schemes, [&](const auto& spec) { return library.brought(spec.name); }))
      out += " plugin=" + library.digest;
  return out;
}

}  // namespace tilepress
