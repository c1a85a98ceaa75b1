// Usage text: CLI11 puts option, value and rule into one text; the patterns below take them apart again.
#include "usage_text.h"

#include <cstdlib>
#include <sstream>
#include <vector>

#include "tilepress/nearest_word.h"
#include "way_out.h"

namespace tilepress {
namespace {

/// The app's name is "tilepress VERB".
std::string see_help(const CLI::App& app) {
  return "see " + app.get_name() + " --help";
}

/// "1000" for "1000.000000".
std::string short_number(std::string digits) {
  if (digits.find('.') == std::string::npos) return digits;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.ends_with('.')) digits.pop_back();
  return digits;
}

/// What a number must be. CLI11's ranges without an end go to the largest number there is, and print their start
/// alike whether zero belongs to them or not.
std::string range_rule(const std::string& given, const std::string& low, const std::string& high) {
  constexpr double kNoEnd = 1e300;
  if (std::strtod(high.c_str(), nullptr) < kNoEnd)
    return "must be a number in " + short_number(low) + ".." + short_number(high);
  return short_number(given) == "0" ? "must be a number above 0" : "must be a number that is not negative";
}

std::vector<std::string> split_words(const std::string& list) {
  std::vector<std::string> words;
  std::stringstream text(list);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

using Parts = std::vector<std::string>;

/// The text before, between and behind the joints, which must stand in this order. Empty if one is not there.
Parts split_by(const std::string& text, const std::vector<std::string_view>& joints) {
  Parts parts;
  size_t from = 0;
  for (const std::string_view joint : joints) {
    const size_t at = text.find(joint, from);
    if (at == std::string::npos) return {};
    parts.push_back(text.substr(from, at - from));
    from = at + joint.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

template <class Kind>
bool is(const CLI::ParseError& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

/// The complaints of CLI11's own checks, in this program's words.
std::string plain_words(const CLI::App& app, const CLI::ParseError& error) {
  const std::string text = error.what();
  Parts part;
  if (is<CLI::ValidationError>(error)) {
    if (part = split_by(text, {": Value ", " not in range ", " to "}); !part.empty())
      return part[0] + " " + part[1] + ": " + range_rule(part[1], part[2], part[3]);
    if (part = split_by(text, {": ", " not in {", "}"}); part.empty()) return text;
    const auto words = split_words(part[2]);
    const std::vector<std::string_view> known(words.begin(), words.end());
    return part[0] + " " + part[1] + ": not one of " + listed_words(known, ", ") + nearest_hint(part[1], known);
  }
  if (part = split_by(text, {": 1 required ", " missing"}); is<CLI::ArgumentMismatch>(error) && !part.empty())
    return part[0] + ": needs " + part[1] + " (" + see_help(app) + ")";
  if (part = split_by(text, {" is required"}); is<CLI::RequiredError>(error) && !part.empty())
    return "no " + part[0] + " given (" + see_help(app) + ")";
  if (part = split_by(text, {" excludes "}); is<CLI::ExcludesError>(error) && !part.empty())
    return part[0] + " and " + part[1] + ": give only one of them";
  if (part = split_by(text, {" was not readable"}); is<CLI::FileError>(error) && !part.empty())
    return "--config " + part[0] + ": no such file" + path_hint(part[0]);
  return text;
}

}  // namespace

std::string ConfigLines::at(const std::string& key) const {
  const auto line = lines.find(key);
  return path + ": " + (line == lines.end() ? "" : "line " + std::to_string(line->second) + ": ");
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unexpected_text(const CLI::App& app, const std::string& word) {
  if (!word.starts_with("-")) return "unexpected argument '" + word + "' (" + see_help(app) + ")";
  const std::string name = word.substr(0, word.find('='));
  const auto names = option_names(app);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string help = nearest_word(name, known).empty() ? see_help(app) : "";
  return "unknown option '" + word + "'" + nearest_hint(name, known, help);
}

std::string usage_text(const CLI::App& app, const CLI::ParseError& error, const ConfigLines& config) {
  if (is<CLI::ExtrasError>(error))
    if (const auto extras = app.remaining(); !extras.empty()) return unexpected_text(app, extras.front());
  const std::string text = error.what(), unknown_key = "INI was not able to parse ";
  if (text.starts_with(unknown_key)) {
    const std::string key = text.substr(unknown_key.size());
    std::vector<std::string> names = option_names(app);
    for (std::string& name : names) name.erase(0, 2);
    return config.at(key) + "unknown option '" + key + "'" + nearest_hint_of(key, names);
  }
  if (is<CLI::ConfigError>(error)) return config.path + ": " + text;
  const std::string plain = plain_words(app, error);
  if (!plain.starts_with("--")) return plain;
  const std::string option = plain.substr(2, plain.find_first_of(" :") - 2);
  return (config.lines.contains(option) ? config.at(option) : "") + plain;
}

}  // namespace tilepress
