// Shim log: the file is opened for each line, because the program may close any descriptor it did not open.
#include "interposer/engine/shim_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include "interposer/run/descriptors.h"

namespace tilepress {
namespace {

int threshold_of(std::string_view level) {
  if (level == "off") return -1;
  if (level == "error") return static_cast<int>(LogLevel::kError);
  if (level == "info") return static_cast<int>(LogLevel::kInfo);
  if (level == "debug" || level == "trace") return static_cast<int>(LogLevel::kDebug);
  return static_cast<int>(LogLevel::kWarn);
}

}  // namespace

ShimLog::ShimLog(std::string path, std::string_view level)
    : path_(std::move(path)), threshold_(threshold_of(level)) {}

void ShimLog::write(LogLevel level, std::string_view text) const {
  if (path_.empty() || static_cast<int>(level) > threshold_) return;
  // Creating comes second: in a folder like /tmp, O_CREAT may fail on a file that another user has made.
  int file = open_above_streams(path_, O_WRONLY | O_APPEND);
  if (file < 0) file = open_above_streams(path_, O_WRONLY | O_APPEND | O_CREAT);
  if (file < 0) return;
  const std::string line = "tilepress: " + std::string(text) + "\n";
  [[maybe_unused]] const ssize_t written = ::write(file, line.data(), line.size());
  close(file);
}

}  // namespace tilepress
