// Shim log: lines for the person who runs the shim, in a file of their own and never in the program's
// streams.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>
#include <string_view>

namespace tilepress {

using ShimLog = spdlog::logger;

/// Makes a logger that appends "tilepress: text" lines to the file `path`. An empty path drops every line.
/// `level` is "error", "warn", "info", "debug" or "off"; an unknown name counts as "warn". Thread-safe, also
/// in a forked child and in a task that outlives the program: holds no lock and no descriptor between two
/// lines.
std::unique_ptr<ShimLog> make_shim_log(const std::string& path, std::string_view level);

}  // namespace tilepress
