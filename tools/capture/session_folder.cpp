// Session folder: small text files, read after the program has ended.
#include "capture/session_folder.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "printable.h"
#include "tilepress/run_folder.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

/// Returns the lines of a regular file, or the target of a symbolic link. Any program may have written them.
std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::error_code code;
  const fs::file_status status = fs::symlink_status(path, code);
  if (fs::is_symlink(status)) lines.push_back(fs::read_symlink(path, code).string());
  if (!fs::is_regular_file(status)) return lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) lines.push_back(printable(line));
  return lines;
}

std::vector<fs::path> files_with(const std::string& folder, const char* extension) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  return files;
}

std::vector<std::string> by_program(const std::vector<std::string>& lines) {
  std::map<std::string, std::set<std::string>> entries;
  for (const std::string& line : lines) {
    // Only the program's name may contain spaces.
    const size_t road = line.rfind(' ');
    const size_t entry =
        road == std::string::npos || road == 0 ? std::string::npos : line.rfind(' ', road - 1);
    if (entry == std::string::npos) continue;
    entries[line.substr(0, entry)].insert(line.substr(entry + 1, road - entry - 1) + " (" +
                                          line.substr(road + 1) + ")");
  }
  std::vector<std::string> out;
  for (const auto& [program, calls] : entries) {
    std::ostringstream text;
    text << program << ":";
    for (const std::string& call : calls) text << (call == *calls.begin() ? " " : ", ") << call;
    out.push_back(text.str());
  }
  return out;
}

/// Opens an abstract socket, which processes with another root or /tmp still find. Returns -1 on failure.
int open_socket(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() + 1 > sizeof address.sun_path) return -1;
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const int made = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (made < 0 || bind(made, reinterpret_cast<const sockaddr*>(&address), length) == 0) return made;
  close(made);
  return -1;
}

}  // namespace

SessionFolder::~SessionFolder() {
  std::error_code code;
  if (!path_.empty()) fs::remove_all(path_, code);
  if (socket_ >= 0) close(socket_);
}

Result<void> SessionFolder::create(const std::string& output) {
  std::string pattern = output + "/.session-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr)
    return Error{ErrorKind::kFile, output + ": " + std::strerror(errno)};
  output_ = output;
  path_ = pattern;
  // A program that root starts may become any user. Its messages still arrive.
  const bool for_all = geteuid() == 0;
  share_like_parent(path_, for_all ? 01777 : 0);
  const int log = open(log_path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (log >= 0) {
    fchmod(log, 0666);
    close(log);
  }
  socket_ = open_socket("tilepress/" + fs::path(path_).filename().string());
  return {};
}

std::vector<CapturedProcess> SessionFolder::captured() const {
  const std::string name = fs::path(path_).filename().string();
  std::vector<CapturedProcess> out;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(output_, code)) {
    if (!fs::is_directory(entry.symlink_status(code))) continue;
    const auto mark = read_session_mark(entry.path().string());
    if (mark && mark->session == name) out.push_back({mark->pid, mark->pid_namespace, entry.path().string()});
  }
  std::sort(out.begin(), out.end(), [](const CapturedProcess& a, const CapturedProcess& b) {
    return std::tie(a.pid, a.run_path) < std::tie(b.pid, b.run_path);
  });
  return out;
}

std::vector<std::string> SessionFolder::seen() const {
  std::vector<std::string> lines;
  for (const fs::path& file : files_with(path_, ".seen"))
    for (std::string& line : lines_of(file)) lines.push_back(std::move(line));
  return by_program(lines);
}

std::vector<std::string> SessionFolder::seen_from_afar() const {
  std::vector<std::string> lines;
  char bytes[512];
  for (ssize_t got = 0; socket_ >= 0 && (got = recv(socket_, bytes, sizeof bytes, 0)) >= 0;) {
    const std::string_view line(bytes, static_cast<size_t>(got));
    lines.push_back(printable(line.substr(0, line.find('\n'))));
  }
  return by_program(lines);
}

std::vector<std::string> SessionFolder::log_lines() const {
  std::vector<std::string> lines = lines_of(log_path());
  for (const fs::path& file : files_with(path_, ".engine"))
    for (const std::string& line : lines_of(file)) lines.push_back(line);
  return lines;
}

}  // namespace tilepress
