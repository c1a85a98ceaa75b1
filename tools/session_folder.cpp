// Session folder: small text files, read once the program has ended.
#include "session_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace tilepress {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

std::vector<fs::path> files_with(const std::string& folder, const char* extension) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  return files;
}

}  // namespace

SessionFolder::~SessionFolder() {
  std::error_code code;
  if (!path_.empty()) fs::remove_all(path_, code);
}

bool SessionFolder::create(std::string& error) {
  const char* variable = std::getenv("TMPDIR");
  std::string base = variable != nullptr && variable[0] == '/' ? variable : "/tmp";
  if (base.find_first_of(" :") != std::string::npos) base = "/tmp";
  std::string pattern = base + "/tilepress-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) {
    error = base + ": " + std::strerror(errno);
    return false;
  }
  path_ = pattern;
  return true;
}

std::string SessionFolder::preloadable(const std::string& library) const {
  if (library.find_first_of(" :") == std::string::npos) return library;
  // The whole folder: the library looks for its engine beside itself.
  const fs::path original(library);
  std::error_code code;
  fs::create_directory_symlink(original.parent_path(), path_ + "/lib", code);
  return path_ + "/lib/" + original.filename().string();
}

std::vector<CapturedProcess> SessionFolder::captured() const {
  std::map<pid_t, std::vector<std::string>> runs;
  for (const fs::path& file : files_with(path_, ".run"))
    runs[static_cast<pid_t>(std::strtol(file.stem().c_str(), nullptr, 10))] = lines_of(file);
  std::vector<CapturedProcess> out;
  for (const auto& [pid, paths] : runs)
    for (const std::string& path : paths) out.push_back({pid, path});
  return out;
}

std::vector<std::string> SessionFolder::seen() const {
  std::map<std::string, std::set<std::string>> entries;
  for (const fs::path& file : files_with(path_, ".seen")) {
    for (const std::string& line : lines_of(file)) {
      // The program's name may hold spaces, entry and road do not.
      const size_t road = line.rfind(' ');
      const size_t entry =
          road == std::string::npos || road == 0 ? std::string::npos : line.rfind(' ', road - 1);
      if (entry == std::string::npos) continue;
      entries[line.substr(0, entry)].insert(line.substr(entry + 1, road - entry - 1) + " (" +
                                            line.substr(road + 1) + ")");
    }
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

std::vector<std::string> SessionFolder::log_lines() const {
  return lines_of(log_path());
}

}  // namespace tilepress
