// Private Xvfb: -displayfd finds a free number, a random cookie excludes other users.
#include "private_xvfb.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "tilepress/program_search.h"

namespace tilepress {
namespace {

constexpr std::chrono::seconds kStartTimeout{20};
constexpr int kLookPeriodMs = 50;

/// Writes an Xauthority file with one entry for any address and display: family 65535, empty address and
/// number, name, cookie. Lengths are big-endian 16 bits.
bool write_cookie(const std::string& path) {
  std::array<char, 16> cookie;
  if (getrandom(cookie.data(), cookie.size(), 0) != static_cast<ssize_t>(cookie.size())) return false;
  static constexpr char kName[] = "MIT-MAGIC-COOKIE-1";
  std::string entry("\xff\xff\0\0\0\0\0\x12", 8);
  entry += kName;
  entry += std::string("\0\x10", 2);
  entry.append(cookie.data(), cookie.size());
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) return false;
  const bool good = write(fd, entry.data(), entry.size()) == static_cast<ssize_t>(entry.size());
  close(fd);
  return good;
}

/// Returns the number that the server writes once it accepts connections; empty if none comes or `stop` is
/// true.
std::string read_number(int fd, const std::function<bool()>& stop) {
  const auto limit = std::chrono::steady_clock::now() + kStartTimeout;
  std::string text;
  char c = 0;
  pollfd ready = {fd, POLLIN, 0};
  while (text.size() < 8 && !stop() && std::chrono::steady_clock::now() < limit) {
    if (poll(&ready, 1, kLookPeriodMs) <= 0) continue;
    if (read(fd, &c, 1) != 1) break;
    if (c == '\n') return text;
    text += c;
  }
  return {};
}

}  // namespace

Result<void> PrivateXvfb::start(const std::string& folder, uint32_t width, uint32_t height,
                                const std::function<bool()>& stop) {
  const Result<std::string> program = find_program("Xvfb");
  if (!program) return Error{program.error().kind, program.error().text + " (Debian package xvfb)"};
  authority_ = folder + "/xauthority";
  int number[2];
  if (!write_cookie(authority_) || pipe2(number, O_CLOEXEC) != 0)
    return Error{ErrorKind::kSystem, authority_ + ": " + std::strerror(errno)};
  const std::string screen =
      std::to_string(std::max(width, 1280u)) + "x" + std::to_string(std::max(height, 1024u)) + "x24";
  const Result<void> started =
      server_.start({*program, "-displayfd", std::to_string(number[1]), "-auth", authority_, "-screen", "0",
                     screen, "-nolisten", "tcp", "-noreset"},
                    {}, number[1]);
  close(number[1]);
  const std::string text = started ? read_number(number[0], stop) : "";
  close(number[0]);
  if (!started) return started;
  display_ = ":" + text;
  if (!text.empty()) return {};
  server_.wait(std::chrono::milliseconds(100));
  const auto& lines = server_.errors().lines();
  return Error{ErrorKind::kSystem, "Xvfb: does not come up" + (lines.empty() ? "" : ": " + lines.back())};
}

}  // namespace tilepress
