// Program search: the file behind a program's name.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Returns the path of the file that execvp would run for `name`: `name` itself if it has a slash, or the
/// first match in PATH. Error, the name first: kFile if there is no such file, kUnsupported if it cannot be
/// run.
Result<std::string> find_program(const std::string& name);

}  // namespace tilepress
