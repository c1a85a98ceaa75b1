// Configuration: a scheme with the values of its keys, as a study counts, names and stores it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tilepress/scheme_spec.h"

namespace tilepress {

/// The value of each key of the scheme as text, in the order of its table. A key that names a file has no
/// text here.
std::vector<std::pair<std::string_view, std::string>> key_values(const SchemeSpec& spec);

/// Returns "name:key=value,…" with only the keys that differ from their defaults, in the order of the table.
/// Two specifications with equal texts model the same. A specification that names a file keeps its own text.
std::string canonical_text(const SchemeSpec& spec);

/// The columns that name a configuration in every table of a study: "configuration,scheme,KEY,…", with the
/// keys of all schemes of the registry, each once. Keys that name files are left out.
std::string configuration_header();
/// The fields of these columns. A field is empty where the scheme has no such key.
void append_configuration(const SchemeSpec& spec, std::string& out);

/// Distinct configurations in the order in which they were added.
class ConfigurationList {
 public:
  /// Adds the configuration unless an equal one is there. Returns the name of the one in the list.
  const std::string& add(const SchemeSpec& spec);
  const std::vector<SchemeSpec>& specs() const { return specs_; }

 private:
  std::vector<SchemeSpec> specs_;
  std::vector<std::string> canonical_;  ///< of specs_
};

}  // namespace tilepress
