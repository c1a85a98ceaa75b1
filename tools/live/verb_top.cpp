// tilepress top: shows running captures in the terminal.
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "live/capture_screen.h"
#include "live/ended_runs.h"
#include "live/running_captures.h"
#include "verb.h"

namespace tilepress {
namespace {
using Clock = std::chrono::steady_clock;

std::atomic<bool> interrupted{false};

/// Switches the terminal to its other screen, without cursor and line input. The destructor restores it.
class LiveTerminal {
 public:
  LiveTerminal() {
    keys_ = isatty(STDIN_FILENO) && tcgetattr(STDIN_FILENO, &before_) == 0;
    if (keys_) {
      termios raw = before_;
      raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
      tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    }
    std::fputs("\x1b[?1049h\x1b[?25l", stdout);
  }
  LiveTerminal(const LiveTerminal&) = delete;
  LiveTerminal& operator=(const LiveTerminal&) = delete;
  ~LiveTerminal() {
    std::fputs("\x1b[?25h\x1b[?1049l", stdout);
    std::fflush(stdout);
    if (keys_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  /// Waits for a key. Returns 0 if none came.
  char key(int wait_ms) const {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char pressed = 0;
    if (poll(keys_ ? &input : nullptr, keys_ ? 1 : 0, wait_ms) > 0 && read(STDIN_FILENO, &pressed, 1) != 1)
      pressed = 0;
    return pressed;
  }

 private:
  termios before_{};
  bool keys_ = false;
};

struct Watch {
  LiveReader reader;
  WatchedCapture capture;
  Clock::time_point read_at;
};

/// The captures at or below the folders, with their last two snapshots.
class CaptureList {
 public:
  explicit CaptureList(const std::vector<std::string>& folders) : folders_(folders) {}
  void refresh() {
    for (const std::string& path : find_running_captures(folders_)) add(path);
    for (auto& [path, watch] : watches_) {
      LiveState state{};
      watch->capture.ended = !capture_runs(path);
      if (!watch->reader.read(state)) continue;
      const auto now = Clock::now();
      watch->capture.before = watch->capture.now;
      watch->capture.elapsed_s = std::chrono::duration<double>(now - watch->read_at).count();
      watch->capture.now = state;
      watch->read_at = now;
    }
  }
  std::vector<std::string> lines(size_t columns) const {
    std::vector<std::string> out;
    for (const auto& [path, watch] : watches_) {
      if (!out.empty()) out.emplace_back();
      for (std::string& line : capture_lines(watch->capture, columns)) out.push_back(std::move(line));
    }
    return out;
  }
  bool empty() const { return watches_.empty(); }

 private:
  void add(const std::string& path) {
    if (watches_.count(path) > 0) return;
    auto watch = std::make_unique<Watch>();
    if (!watch->reader.open(path) || !watch->reader.read(watch->capture.now)) return;
    watch->capture.path = path;
    watch->read_at = Clock::now();
    watches_[path] = std::move(watch);
  }
  std::vector<std::string> folders_;
  std::map<std::string, std::unique_ptr<Watch>> watches_;
};

std::vector<std::string> waiting_lines(const std::vector<std::string>& folders) {
  std::vector<std::string> lines = {"waiting for a capture in " + folders.front() + " …"};
  for (const std::string& folder : folders)
    if (const std::string ended = ended_runs_text(folder); !ended.empty())
      lines.push_back(folder + ": " + ended);
  return lines;
}

void show_screen(const CaptureList& captures, const std::vector<std::string>& folders) {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 4;
  const size_t columns = known ? size.ws_col : 80, rows = known ? size.ws_row : 24;
  std::vector<std::string> lines = captures.lines(columns);
  if (captures.empty()) lines = waiting_lines(folders);
  std::string out = "\x1b[H";
  if (lines.size() + 2 > rows) {
    const size_t more = lines.size() + 3 - rows;
    lines.resize(rows - 3);
    lines.push_back("… " + std::to_string(more) + " more lines than the terminal has");
  }
  for (const std::string& line : lines) out += line + "\x1b[K\n";
  out += "\x1b[K\nq quits; the programs go on\x1b[K\x1b[J";
  std::fwrite(out.data(), 1, out.size(), stdout);
  std::fflush(stdout);
}

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress top\n"
    "  tilepress top --interval 0.2 out\n"
    "  tilepress top --once out\n";

}  // namespace

int verb_top(int argc, char** argv) {
  std::vector<std::string> folders;
  double interval_s = 1;
  bool once = false;
  CLI::App app{
      "Shows running captures: frames per second, rates, FVC coverage, queue and cost. It only reads."};
  app.footer(kExamples);
  app.add_option("DIR", folders, "Output folders of `tilepress run` (default: tilepress-out)");
  app.add_option("--interval", interval_s, "Seconds between two updates (default: 1)")
      ->type_name("S")
      ->check(CLI::Range(0.05, 3600.0));
  app.add_flag("--once", once, "Print the running captures once; exit 3 if there is none");
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;
  if (folders.empty()) folders = {"tilepress-out"};
  if (const auto checked = check_capture_folders(folders); !checked)
    return fail(kExitFailed, checked.error());

  CaptureList captures(folders);
  captures.refresh();
  const int wait_ms = static_cast<int>(interval_s * 1000);
  if (once || !isatty(STDOUT_FILENO)) {
    if (captures.empty()) {
      const std::string ended = ended_runs_text(folders.front());
      return fail(kExitNothingCaptured,
                  folders.front() + ": no running capture" + (ended.empty() ? "" : "; " + ended));
    }
    poll(nullptr, 0, wait_ms);  // frames per second need a second snapshot
    captures.refresh();
    for (const std::string& line : captures.lines(200)) std::printf("%s\n", line.c_str());
    return kExitDone;
  }
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  action.sa_handler = [](int) {};  // ends the wait, so that the screen is drawn in its new size
  sigaction(SIGWINCH, &action, nullptr);
  const LiveTerminal terminal;
  for (char key = 0; !interrupted && key != 'q' && key != 'Q'; key = terminal.key(wait_ms)) {
    captures.refresh();
    show_screen(captures, folders);
  }
  return kExitDone;
}

}  // namespace tilepress
