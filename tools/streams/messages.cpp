// Messages: one spdlog logger over one sink, which leads to the true standard error.
#include "streams/messages.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <mutex>
#include <string>

#include "streams/standard_streams.h"

namespace tilepress {
namespace {

constexpr const char* kClearLine = "\r\033[K";

/// Text that cannot be written is lost: there is no other place to report it.
void write_all(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(true_standard_error(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    text.remove_prefix(static_cast<size_t>(written));
  }
}

std::string one_line(std::string_view text) {
  std::string line(text.substr(0, text.find_last_not_of('\n') + 1));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = c == '\n' || c == '\r' ? ' ' : '?';
  return line;
}

class StandardErrorSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  void show(std::string_view text) {
    const std::lock_guard lock(mutex_);
    write_text(text);
  }
  void show_progress(std::string_view line) {
    const std::lock_guard lock(mutex_);
    write_all(std::string("\r").append(line).append("\033[K"));
    progress_shown_ = true;
  }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string line = one_line({message.payload.data(), message.payload.size()});
    spdlog::details::log_msg cleaned = message;
    cleaned.payload = line;
    spdlog::memory_buf_t text;
    formatter_->format(cleaned, text);
    write_text({text.data(), text.size()});
  }
  void flush_() override {}

  void write_text(std::string_view text) {
    write_all(progress_shown_ ? std::string(kClearLine).append(text) : text);
    progress_shown_ = false;
  }

  bool progress_shown_ = false;
};

const std::shared_ptr<StandardErrorSink>& sink() {
  static const auto the_sink = std::make_shared<StandardErrorSink>();
  return the_sink;
}

spdlog::logger& logger() {
  static const auto the_logger = [] {
    auto made = std::make_shared<spdlog::logger>("tilepress", sink());
    made->set_pattern("tilepress: %v");
    made->set_level(spdlog::level::warn);
    spdlog::set_default_logger(made);
    return made;
  }();
  return *the_logger;
}

/// Errors are logged as critical, which every level of --log-level lets through.
constexpr spdlog::level::level_enum kLevels[] = {spdlog::level::info, spdlog::level::warn,
                                                 spdlog::level::critical};

}  // namespace

void open_messages() {
  logger();
}

void set_message_level(std::string_view name) {
  logger().set_level(std::min(spdlog::level::from_str(std::string(name)), spdlog::level::critical));
}

void say(MessageLevel level, std::string_view line) {
  logger().log(kLevels[static_cast<size_t>(level)], spdlog::string_view_t(line.data(), line.size()));
}

int fail(int status, std::string_view line) {
  say(MessageLevel::kError, line);
  return status;
}

int fail(int status, const Error& error) {
  return fail(status, error.text);
}

void show(std::string_view text) {
  sink()->show(text);
}

void show_progress(std::string_view line) {
  sink()->show_progress(line);
}

void clear_progress() {
  sink()->show({});
}

}  // namespace tilepress
