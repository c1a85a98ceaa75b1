// Study file: toml++ reads the text, tables name the keys that each part takes.
#include "study_file.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <variant>

#include "input_kind.h"
#include "study/configuration.h"
#include "tilepress/nearest_word.h"
#include "tilepress/plugin_library.h"
#include "tilepress/run_options.h"
#include "tilepress/whole_file.h"
#include "toml_text.h"
#include "way_out.h"

namespace tilepress {

// The built-in studies, paper.toml with figures/paper_figures.toml, and the example, embedded at build time.
extern const std::string_view kPaperStudy, kPaperFigures, kSensitivityStudy, kExampleStudy;

namespace {

/// A number or text as text.
Result<std::string> word(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<int64_t>()) return std::to_string(*number);
  if (const auto number = node.value_exact<double>()) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << *number;
    return text.str();
  }
  return at_line(node, "must be text or a number");
}

Result<std::vector<std::string>> words(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr) return at_line(node, "must be a list");
  std::vector<std::string> out;
  for (const toml::node& element : *list) {
    auto text = word(element);
    if (!text) return text.error();
    out.push_back(*text);
  }
  return out;
}

/// Where the value of each key of a table goes. Keys without a place are read elsewhere.
using Place = std::variant<std::monostate, std::string*, std::vector<std::string>*>;
using TableKeys = std::vector<std::pair<std::string_view, Place>>;

Result<void> take_table(const toml::table& table, const TableKeys& keys) {
  std::vector<std::string_view> names;
  for (const auto& [name, place] : keys) names.push_back(name);
  for (const auto& [key_node, node] : table) {
    const std::string_view key = key_node.str();
    const auto known = std::ranges::find(names, key);
    if (known == names.end())
      return at_line(node, "unknown key '" + std::string(key) + "'" + nearest_hint(key, names));
    const Place& place = keys[static_cast<size_t>(known - names.begin())].second;
    if (const auto text = std::get_if<std::string*>(&place)) {
      const auto value = word(node);
      if (!value) return about(key, value.error());
      **text = *value;
    } else if (const auto list = std::get_if<std::vector<std::string>*>(&place)) {
      const auto values = words(node);
      if (!values) return about(key, values.error());
      **list = *values;
    }
  }
  return {};
}

/// Calls `take` for each table of the list `name`. No list is no error.
template <class Take>
Result<void> for_each_table(const toml::table& root, std::string_view name, const Take& take) {
  const toml::node* node = root.get(name);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  if (list == nullptr) return at_line(*node, "write [[" + std::string(name) + "]]");
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) return at_line(entry, "write [[" + std::string(name) + "]]");
    if (const Result<void> taken = take(*entry.as_table()); !taken) return taken;
  }
  return {};
}

/// Loads the libraries of the key `plugins`, relative to `folder`. The study.toml of a study folder may name some
/// that lie elsewhere: its invocation.json has loaded these.
Result<void> load_plugins(const toml::table& root, const std::filesystem::path& folder) {
  const toml::node* node = root.get("plugins");
  if (node == nullptr) return {};
  const auto names = words(*node);
  if (!names) return about("plugins", names.error());
  const bool stored = std::filesystem::exists(folder / "invocation.json");
  for (const std::string& name : *names) {
    const std::string path = std::filesystem::absolute(folder / name).lexically_normal().string();
    if (stored && !std::filesystem::exists(path)) continue;
    if (const auto loaded = load_plugin(path); !loaded)
      return at_line(*node, "plugin " + path + ": " + loaded.error().text);
  }
  return {};
}

class StudyParser {
 public:
  Result<StudyFile> parse(const toml::table& root) {
    std::vector<std::string> listed, bursts;
    Result<void> done = take_table(root, {{"plugins", {}},
                                          {"category", {}},
                                          {"axis", {}},
                                          {"figure", {}},
                                          {"name", &study_.name},
                                          {"title", &study_.title},
                                          {"baseline", &study_.baseline},
                                          {"configurations", &listed},
                                          {"inputs", &study_.inputs},
                                          {"bursts", &bursts}});
    if (done && study_.name.empty()) done = at_line(root, "name = \"...\" is missing");
    if (study_.title.empty()) study_.title = study_.name;
    for (size_t i = 0; done && i < bursts.size(); ++i) done = take_burst(*root.get("bursts"), bursts[i]);
    for (size_t i = 0; done && i < listed.size(); ++i)
      done = add_configurations(*root.get("configurations"), listed[i]);
    if (done)
      done = for_each_table(root, "category", [&](const auto& table) { return take_category(table); });
    if (done) done = for_each_table(root, "axis", [&](const auto& table) { return take_axis(table); });
    if (done) done = take_figures(root);
    if (!done) return done.error();
    study_.configurations = configurations_.specs();
    if (study_.configurations.empty())
      return Error{ErrorKind::kBadValue, "has no configurations (list them, or declare an [[axis]])"};
    return finish(root);
  }

 private:
  Result<void> take_burst(const toml::node& where, const std::string& text) {
    RunOptions options;
    if (const auto set = set_run_option(options, "burst", text); !set) return at_line(where, set.error().text);
    if (std::ranges::count(study_.bursts, options.model.burst_bits) > 0)
      return at_line(where, "the burst " + text + " is there twice");
    study_.bursts.push_back(options.model.burst_bits);
    return {};
  }

  Result<std::string> add_configuration(const toml::node& where, const std::string& text) {
    const auto spec = parse_scheme(text);
    if (!spec) return at_line(where, spec.error().text);
    return configurations_.add(*spec);
  }

  /// `text` may hold lists of values, as -s takes them.
  Result<void> add_configurations(const toml::node& where, const std::string& text) {
    const auto specs = parse_schemes(text);
    if (!specs) return at_line(where, specs.error().text);
    for (const SchemeSpec& spec : *specs) configurations_.add(spec);
    return {};
  }

  Result<void> take_category(const toml::table& table) {
    StudyCategory category;
    const auto taken = take_table(
        table, {{"name", &category.name}, {"title", &category.title}, {"workloads", &category.workloads}});
    if (!taken) return taken;
    if (category.name.empty()) return at_line(table, "a category without name");
    if (std::ranges::count(study_.categories, category.name, &StudyCategory::name) > 0)
      return at_line(table, "the category '" + category.name + "' is there twice");
    if (category.title.empty()) category.title = category.name;
    study_.categories.push_back(std::move(category));
    return {};
  }

  Result<void> take_axis(const toml::table& table) {
    StudyAxis axis;
    const auto taken = take_table(table, {{"name", &axis.name},
                                          {"title", &axis.title},
                                          {"scheme", &axis.scheme},
                                          {"key", &axis.key},
                                          {"fixed", &axis.fixed},
                                          {"values", &axis.values}});
    if (!taken) return taken;
    if (axis.name.empty() || axis.scheme.empty() || axis.key.empty())
      return at_line(table, "an axis needs name, scheme and key");
    if (std::ranges::count(study_.axes, axis.name, &StudyAxis::name) > 0)
      return at_line(table, "the axis '" + axis.name + "' is there twice");
    if (axis.title.empty()) axis.title = axis.key;
    if (axis.values.empty()) {
      study_.remarks.push_back("axis '" + axis.name + "' has no values and is left out");
      return {};
    }
    for (const std::string& value : axis.values) {
      const std::string fixed = axis.fixed.empty() ? "" : axis.fixed + ",";
      // The list holds the shortest name of a configuration: an axis passes through the base.
      const auto spec = parse_scheme(axis.scheme + ":" + fixed + axis.key + "=" + value);
      if (!spec) return at_line(table, "axis '" + axis.name + "': " + spec.error().text);
      const auto named = add_configuration(table, canonical_text(*spec));
      if (!named) return named.error();
      axis.configurations.push_back(*named);
    }
    study_.axes.push_back(std::move(axis));
    return {};
  }

  /// Who draws the figures checks them.
  Result<void> take_figures(const toml::table& root) {
    const toml::node* figures = root.get("figure");
    study_.figures_json = "[]";
    if (figures == nullptr) return {};
    if (!figures->is_array_of_tables()) return at_line(*figures, "write [[figure]]");
    std::ostringstream json;
    json << toml::json_formatter{*figures};
    study_.figures_json = json.str();
    return {};
  }

  Result<StudyFile> finish(const toml::table& root) {
    if (study_.baseline.empty()) study_.baseline = study_.configurations.front().text;
    const auto spec = parse_scheme(study_.baseline);
    if (!spec) return at_line(*root.get("baseline"), spec.error().text);
    const std::string& named = configurations_.add(*spec);
    if (configurations_.specs().size() != study_.configurations.size())
      return at_line(*root.get("baseline"),
                     "baseline '" + study_.baseline + "' is no configuration of the study");
    study_.baseline = named;
    return std::move(study_);
  }

  StudyFile study_;
  ConfigurationList configurations_;
};

}  // namespace

static Result<StudyFile> parse_study_in(const std::filesystem::path& folder, std::string_view text) {
  const auto table = parse_toml([&] { return toml::parse(text); });
  if (!table) return table.error();
  if (const auto loaded = load_plugins(*table, folder); !loaded) return loaded.error();
  auto study = StudyParser().parse(*table);
  if (study) study->text = text;
  return study;
}

Result<StudyFile> parse_study(std::string_view text) {
  return parse_study_in("", text);
}

std::string built_in_study(std::string_view name) {
  if (name == "sensitivity") return std::string(kSensitivityStudy);
  return name == "paper" ? std::string(kPaperStudy).append(kPaperFigures) : "";
}

std::string_view example_study() {
  return kExampleStudy;
}

Result<StudyFile> load_study(const std::string& name) {
  const std::string built_in = built_in_study(name);
  const auto text = built_in.empty() ? read_whole_file(name) : Result<std::string>(built_in);
  if (!text) {
    Error error = text.error();
    constexpr std::string_view kWords[] = {"paper", "sensitivity", "status", "retry", "merge", "cache"};
    const std::string near_word = nearest_hint(name, kWords);
    if (std::filesystem::is_directory(name))
      error.text =
          name + ": is a folder; name a study before it, as in tilepress study paper " + shell_word(name);
    if (!std::filesystem::exists(name)) error.text += near_word.empty() ? path_hint(name) : near_word;
    return error;
  }
  const auto folder = std::filesystem::path(name).parent_path();
  auto study = parse_study_in(folder, *text);
  if (!study && !verb_hint(name).empty())
    return Error{ErrorKind::kFile,
                 name + ": is no study; name one before it, as in tilepress study paper " + shell_word(name)};
  if (!study) return about(name, study.error());
  for (std::string& input : study->inputs) input = (folder / input).lexically_normal().string();
  return study;
}

}  // namespace tilepress
