// Run option table: one row per option. The parser, the environment, run.json, the command line and its help
// follow from this table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tilepress/run_options.h"

namespace tilepress {

/// How run.json holds an option.
enum class JsonForm : uint8_t { kAbsent, kList, kNumber, kBoolean, kText };

/// Whether an option changes a run's rows, and how rows_fingerprint() shows the option.
enum class RowsEffect : uint8_t {
  kNone,
  kValue,          ///< "value"
  kAssigned,       ///< "name=value"
  kUnlessDefault,  ///< "name=value" where the value is not the default
};

struct RunOption;

/// How an option is read from text and printed as the text that reads back.
struct OptionText {
  /// The error is "value: reason". Of a list it names the one value at fault.
  Result<void> (*set)(const RunOption& option, RunOptions& options, std::string_view value);
  /// Empty for a default that has no text.
  std::string (*print)(const RunOptions& options);
};

struct RunOption {
  std::string_view name;      ///< long name without dashes
  std::string_view variable;  ///< TILEPRESS_*
  std::string_view range;     ///< the values it takes, to follow "must be"
  OptionText text;
  struct {
    JsonForm form = JsonForm::kAbsent;
    std::string_view key;
  } json = {};
  RowsEffect rows = RowsEffect::kNone;
  std::string_view flags = {};    ///< on the command line: "-s,--scheme"; empty = not there
  std::string_view metavar = {};  ///< in the help; empty = a flag without a value
  char joint = 0;  ///< between the values of an option that is given several times; 0 = given once
  std::string_view help = {};
};

/// In the order of run.json, after the options of the log.
std::span<const RunOption> run_option_table();

/// Null if there is no option of this name.
const RunOption* find_run_option(std::string_view name);

}  // namespace tilepress
