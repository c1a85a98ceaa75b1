// Configuration columns: the columns that name a configuration in every table of a study.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tilepress/scheme_spec.h"

namespace tilepress {

/// The keys of all schemes of the registry, each once. Keys that name files are left out.
std::vector<std::string_view> all_key_names();

/// "configuration,scheme,KEY,…"
std::string configuration_header();
/// The fields of these columns. A field is empty where the scheme has no such key.
void append_configuration(const SchemeSpec& spec, std::string& out);

}  // namespace tilepress
