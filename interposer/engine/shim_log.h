// Shim log: lines for the person who runs the shim, in a file of their own, never in the program's streams.
#pragma once

#include <string>
#include <string_view>

namespace tilepress {

enum class LogLevel { kError, kWarn, kInfo, kDebug };

/// Appends to one file, a write() per line. Without a file every line is dropped. Thread-safe.
class ShimLog {
 public:
  /// level: "error", "warn", "info", "debug" or "off"; unknown names count as "warn".
  ShimLog(std::string path, std::string_view level);
  /// Writes "tilepress: text" if the level is wanted.
  void write(LogLevel level, std::string_view text) const;

 private:
  std::string path_;
  int threshold_;
};

}  // namespace tilepress
