// Configuration columns: a column per key, defaults included.
#include "configuration_columns.h"

#include <algorithm>

#include "study/configuration.h"
#include "tilepress/csv_table.h"
#include "tilepress/scheme.h"

namespace tilepress {

std::vector<std::string_view> all_key_names() {
  std::vector<std::string_view> names;
  for (const SchemeInfo& info : scheme_registry())
    for (const SchemeKey& key : info.keys)
      if (key.kind != KeyKind::kFile && std::ranges::find(names, key.name) == names.end())
        names.emplace_back(key.name);
  return names;
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

}  // namespace tilepress
