// Configuration: texts of keys from the registry's tables.
#include "configuration.h"

#include <algorithm>

#include "tilepress/csv_table.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

std::string choice_word(const SchemeKey& key, uint32_t position) {
  std::string_view words = key.choices;
  for (; position > 0; --position) words.remove_prefix(words.find(", ") + 2);
  return std::string(words.substr(0, words.find(',')));
}

std::string value_text(const SchemeKey& key, const SchemeValue& value) {
  if (const double* share = std::get_if<double>(&value)) return csv_number(*share);
  const uint32_t number = std::get<uint32_t>(value);
  return key.kind == KeyKind::kChoice ? choice_word(key, number) : std::to_string(number);
}

bool is_default(const SchemeKey& key, const SchemeValue& value) {
  if (const double* share = std::get_if<double>(&value)) return *share == 0;
  return std::get<uint32_t>(value) == key.initial;
}

/// A number 0 outside a key's range is a default that the help has a word for, such as "fvc" for ways.
std::string shown_value(const SchemeKey& key, const SchemeValue& value) {
  if (key.help_initial != nullptr && is_default(key, value)) return key.help_initial;
  return value_text(key, value);
}

bool names_file(const SchemeSpec& spec) {
  return std::ranges::any_of(spec.values, [](const auto& value) {
    const auto* numbers = std::get_if<std::vector<uint32_t>>(&value.second);
    return numbers != nullptr && !numbers->empty();
  });
}

template <class Visit>
void for_each_key(const SchemeSpec& spec, const Visit& visit) {
  const SchemeInfo* info = find_scheme(spec.name);
  for (size_t i = 0; i < spec.values.size(); ++i)
    if (info->keys[i].kind != KeyKind::kFile) visit(info->keys[i], spec.values[i].second);
}

std::vector<std::string_view> all_key_names() {
  std::vector<std::string_view> names;
  for (const SchemeInfo& info : scheme_registry())
    for (const SchemeKey& key : info.keys)
      if (key.kind != KeyKind::kFile && std::ranges::find(names, key.name) == names.end())
        names.emplace_back(key.name);
  return names;
}

}  // namespace

std::vector<std::pair<std::string_view, std::string>> key_values(const SchemeSpec& spec) {
  std::vector<std::pair<std::string_view, std::string>> out;
  for_each_key(spec, [&](const SchemeKey& key, const SchemeValue& value) {
    out.emplace_back(key.name, shown_value(key, value));
  });
  return out;
}

std::string canonical_text(const SchemeSpec& spec) {
  if (names_file(spec)) return spec.text;
  std::string out = spec.name;
  for_each_key(spec, [&](const SchemeKey& key, const SchemeValue& value) {
    if (is_default(key, value)) return;
    out += out.size() == spec.name.size() ? ':' : ',';
    out.append(key.name).append("=").append(value_text(key, value));
  });
  return out;
}

std::string configuration_header() {
  std::string out = "configuration,scheme";
  for (const std::string_view name : all_key_names()) out.append(",").append(name);
  return out;
}

void append_configuration(const SchemeSpec& spec, std::string& out) {
  append_csv(out, spec.text);
  append_csv(out += ',', spec.name);
  const auto values = key_values(spec);
  for (const std::string_view name : all_key_names()) {
    out += ',';
    const auto value = std::ranges::find(values, name, [](const auto& known) { return known.first; });
    if (value != values.end()) append_csv(out, value->second);
  }
}

const std::string& ConfigurationList::add(const SchemeSpec& spec) {
  std::string canonical = canonical_text(spec);
  const auto known = std::ranges::find(canonical_, canonical);
  if (known != canonical_.end()) return specs_[static_cast<size_t>(known - canonical_.begin())].text;
  canonical_.push_back(std::move(canonical));
  specs_.push_back(spec);
  return specs_.back().text;
}

}  // namespace tilepress
