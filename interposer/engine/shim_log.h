// Shim log: lines for the person who runs the shim, in a file of their own and never in the program's
// streams.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace spdlog {
class logger;
}

namespace tilepress {

/// Appends "tilepress: text" lines to a file. Thread-safe, also in a forked child and in a task that outlives
/// the program: holds no lock and no descriptor between two lines.
class ShimLog {
 public:
  /// An empty path drops every line. `level` is "error", "warn", "info", "debug" or "off"; an unknown name
  /// counts as "warn".
  ShimLog(const std::string& path, std::string_view level);
  ~ShimLog();
  void error(std::string_view text);
  void warn(std::string_view text);
  void info(std::string_view text);
  void debug(std::string_view text);

 private:
  const std::unique_ptr<spdlog::logger> logger_;
};

}  // namespace tilepress
