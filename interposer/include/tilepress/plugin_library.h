// Plugin library: a shared library that brings schemes into this process (tilepress_plugin.h).
#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

struct PluginLibrary {
  std::string path;    ///< absolute
  std::string digest;  ///< of the file when it was loaded: two libraries with other code differ
  std::vector<std::string> schemes;

  bool brought(std::string_view scheme) const {
    return std::find(schemes.begin(), schemes.end(), scheme) != schemes.end();
  }
};

/// Loads the library for good and registers its schemes. Does nothing if it is loaded already. The caller
/// parses no scheme and makes no engine meanwhile. Error: one line without the path.
Result<void> load_plugin(const std::string& path);

/// The libraries of this process in the order in which they were loaded.
const std::deque<PluginLibrary>& loaded_plugins();

}  // namespace tilepress
