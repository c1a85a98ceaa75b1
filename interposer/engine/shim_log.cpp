// Shim log: opens the file for each line, because the program may close any descriptor that it did not open.
#include "interposer/engine/shim_log.h"

#include <fcntl.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/sink.h>
#include <unistd.h>

#include "interposer/run/descriptors.h"

namespace tilepress {
namespace {

/// One write() per line. Uses no formatter: those of spdlog ask for the local time, which takes a lock that a
/// thread may hold at a fork.
class AppendingSink final : public spdlog::sinks::sink {
 public:
  explicit AppendingSink(std::string path) : path_(std::move(path)) {}

  void log(const spdlog::details::log_msg& message) override {
    // O_CREAT comes second: in a folder like /tmp it may fail for a file that another user has made.
    int file = open_above_streams(path_, O_WRONLY | O_APPEND);
    if (file < 0) file = open_above_streams(path_, O_WRONLY | O_APPEND | O_CREAT);
    if (file < 0) return;
    const std::string line =
        "tilepress: " + std::string(message.payload.data(), message.payload.size()) + "\n";
    [[maybe_unused]] const ssize_t written = write(file, line.data(), line.size());
    close(file);
  }
  void flush() override {}
  void set_pattern(const std::string&) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter>) override {}

 private:
  const std::string path_;
};

spdlog::level::level_enum level_of(std::string_view name) {
  const auto level = spdlog::level::from_str(std::string(name));
  return level == spdlog::level::off && name != "off" ? spdlog::level::warn : level;
}

}  // namespace

ShimLog::ShimLog(const std::string& path, std::string_view level)
    : logger_(std::make_unique<spdlog::logger>("tilepress", std::make_shared<AppendingSink>(path))) {
  logger_->set_level(path.empty() ? spdlog::level::off : level_of(level));
  logger_->set_error_handler([](const std::string&) {});  // the default one writes to standard error
}

ShimLog::~ShimLog() = default;

void ShimLog::error(std::string_view text) {
  logger_->error(text);
}
void ShimLog::warn(std::string_view text) {
  logger_->warn(text);
}
void ShimLog::info(std::string_view text) {
  logger_->info(text);
}
void ShimLog::debug(std::string_view text) {
  logger_->debug(text);
}

}  // namespace tilepress
