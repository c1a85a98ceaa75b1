// Program search: where a program lies in PATH.
#pragma once

#include <string>

namespace tilepress {

/// Absolute path of the program `name`; empty if PATH has none.
std::string find_in_path(const std::string& name);

}  // namespace tilepress
