// Way out: looks for similar names one folder at a time.
#include "way_out.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tilepress/nearest_word.h"
#include "tilepress/scheme.h"

namespace tilepress {

namespace fs = std::filesystem;

static std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (auto entry = fs::directory_iterator(folder.empty() ? "." : folder, code);
       !code && entry != fs::directory_iterator(); entry.increment(code))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string path_hint(const std::string& path) {
  // A shell replaced the braces of a list of schemes.
  if (path.find('=') != std::string::npos && find_scheme(path.substr(0, path.find(':'))) != nullptr)
    return " (a scheme? Put it in quotes: -s '" + path.substr(0, path.find('=')) + "={...}')";
  std::error_code code;
  fs::path known;
  const fs::path whole(path);
  for (auto part = whole.begin(); part != whole.end(); ++part) {
    if (fs::exists(known / *part, code)) {
      known /= *part;
      continue;
    }
    const auto names = names_in(known);
    const std::vector<std::string_view> words(names.begin(), names.end());
    const std::string_view nearest = nearest_word(part->string(), words);
    if (nearest.empty()) return {};
    known /= nearest;
    while (++part != whole.end()) known /= *part;
    return " (did you mean '" + known.string() + "'?)";
  }
  return {};
}

bool x_server_answers(const std::string& display) {
  const size_t colon = display.rfind(':');
  if (colon == std::string::npos) return false;
  const std::string host = display.substr(0, colon);
  if (!host.empty() && host != "unix") return true;
  const std::string path = "/tmp/.X11-unix/X" + std::to_string(std::atoi(display.c_str() + colon + 1));
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  // Linux servers also listen under the same name in the abstract namespace, some only there.
  bool answers = connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (!answers) {
    std::memset(address.sun_path, 0, sizeof address.sun_path);
    path.copy(address.sun_path + 1, sizeof address.sun_path - 2);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + path.size());
    answers = connect(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0;
  }
  close(fd);
  return answers;
}

std::string display_hint(const std::string& verb) {
  const auto value_of = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::string(value != nullptr ? value : "");
  };
  const std::string display = value_of("DISPLAY");
  if (!value_of("WAYLAND_DISPLAY").empty() || (!display.empty() && x_server_answers(display))) return {};
  return (display.empty() ? "  there is no DISPLAY" : "  no X server answers at DISPLAY=" + display) +
         ": `xvfb-run -a tilepress " + verb +
         " ...` gives the program a private one,\n"
         "  and `tilepress replay` needs none for a recorded trace\n";
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

std::string next_command(const std::string& folder) {
  return "  next: tilepress report " + shell_word(folder) + " -o report.html\n";
}

std::vector<std::string> missing_paths(const std::vector<std::string>& paths) {
  std::vector<std::string> missing;
  std::error_code code;
  for (const std::string& path : paths)
    if (path != "-" && !fs::exists(path, code)) missing.push_back(path);
  return missing;
}

std::string missing_text(const std::string& path) {
  return path + ": No such file or directory" + path_hint(path);
}

Result<void> check_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code code;
  if (folder.empty() || fs::is_directory(folder, code)) return {};
  return Error{ErrorKind::kFile, path + ": there is no folder " + folder.string() + " (mkdir -p " +
                                     shell_word(folder.string()) + ")"};
}

}  // namespace tilepress
