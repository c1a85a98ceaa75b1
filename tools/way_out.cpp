// Way out: looks for similar names one folder at a time.
#include "way_out.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tilepress/nearest_word.h"

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

bool lacks_display() {
  const auto named = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
  };
  return !named("DISPLAY") && !named("WAYLAND_DISPLAY");
}

std::string display_hint(const std::string& verb) {
  return "  there is no DISPLAY: `xvfb-run -a tilepress " + verb +
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
  return Error{ErrorKind::kFile, path + ": there is no folder " + folder.string()};
}

}  // namespace tilepress
