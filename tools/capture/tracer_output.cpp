// Tracer output: a pipe in the place of standard error.
#include "capture/tracer_output.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tilepress {

constexpr std::string_view kTracer = "apitrace: ";
/// How often the thread checks whether to end, and what it reads then: a daemon of the program may keep the
/// pipe open, and write into it, for ever.
constexpr int kStopPeriodMs = 20;
constexpr size_t kRestBytes = 65536;

void TracerOutput::begin() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  given_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (given_ < 0) {
    close(ends[0]);
    close(ends[1]);
    return;
  }
  dup2(ends[1], STDERR_FILENO);
  close(ends[1]);
  pipe_ = ends[0];
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void TracerOutput::end() {
  if (pipe_ < 0) return;
  dup2(given_, STDERR_FILENO);
  thread_ = {};
  close(given_);
  close(pipe_);
  pipe_ = -1;
}

void TracerOutput::run(const std::stop_token& stop) {
  char bytes[4096];
  pollfd input{pipe_, POLLIN, 0};
  for (size_t rest = kRestBytes; rest >= sizeof bytes; rest -= stop.stop_requested() ? sizeof bytes : 0) {
    if (poll(&input, 1, kStopPeriodMs) == 0) {
      if (stop.stop_requested()) break;
      continue;
    }
    const ssize_t got = read(pipe_, bytes, sizeof bytes);
    if (got <= 0) break;
    take({bytes, static_cast<size_t>(got)});
  }
  pass(line_);
}

void TracerOutput::take(std::string_view bytes) {
  std::string passed;
  for (const char byte : bytes) {
    line_ += byte;
    if (passes_line_ || !(line_.starts_with(kTracer) || kTracer.starts_with(line_))) {
      passed += line_;
      line_.clear();
      passes_line_ = byte != '\n';
    } else if (byte == '\n') {
      lines_.push_back(line_.substr(0, line_.size() - 1));
      line_.clear();
    }
  }
  pass(passed);
}

void TracerOutput::pass(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = write(given_, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<size_t>(written));
  }
}

}  // namespace tilepress
