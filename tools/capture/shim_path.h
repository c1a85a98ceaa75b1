// Shim path: where the libraries and programs are that the command preloads, loads or runs.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Looks for `part`, a file that is installed beside the shim, relative to this executable: in an installed
/// tree (../lib, ../lib/tilepress) and in a build tree (../interposer). Returns an absolute path. Error:
/// kFile, with the places it looked at.
Result<std::string> find_shim(const std::string& part);

}  // namespace tilepress
