// Private Xvfb: -displayfd finds a free number, a random cookie keeps others out.
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

#include "program_search.h"

namespace tilepress {
namespace {

constexpr std::chrono::seconds kStartTimeout{20};
constexpr int kLookPeriodMs = 50;

/// An Xauthority file with one entry for any address and display: family 65535, empty address and number,
/// name, cookie; lengths are big-endian 16 bits.
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

/// The number that the server writes once it accepts connections. Empty if it does not, or to be stopped.
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

bool PrivateXvfb::start(const std::string& folder, uint32_t width, uint32_t height,
                        const std::function<bool()>& stop, std::string& error) {
  const std::string program = find_in_path("Xvfb");
  if (program.empty()) {
    error = "Xvfb: not found (Debian package xvfb)";
    return false;
  }
  authority_ = folder + "/xauthority";
  int number[2];
  if (!write_cookie(authority_) || pipe2(number, O_CLOEXEC) != 0) {
    error = authority_ + ": " + std::strerror(errno);
    return false;
  }
  const std::string screen =
      std::to_string(std::max(width, 1280u)) + "x" + std::to_string(std::max(height, 1024u)) + "x24";
  const bool started = server_.start({program, "-displayfd", std::to_string(number[1]), "-auth", authority_,
                                      "-screen", "0", screen, "-nolisten", "tcp", "-noreset"},
                                     {}, error, number[1]);
  close(number[1]);
  const std::string text = started ? read_number(number[0], stop) : "";
  close(number[0]);
  if (started && text.empty()) {
    server_.wait(std::chrono::milliseconds(100));
    const auto& lines = server_.errors().lines();
    error = "Xvfb: does not come up" + (lines.empty() ? "" : ": " + lines.back());
  }
  display_ = ":" + text;
  return !text.empty();
}

}  // namespace tilepress
