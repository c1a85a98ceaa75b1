// Image folders: the content of each file decides, as it does for a file that is named.
#include "frames/image_folders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "images/image_kind.h"
#include "input_kind.h"

namespace tilepress {

namespace fs = std::filesystem;

static bool is_digit(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

/// Whether `a` comes first: runs of digits compare by value, everything else by letter.
static bool comes_before(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const auto run = [](const std::string& text, size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const size_t begin = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string x = run(a, i), y = run(b, j);
    if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  }
  const size_t left_of_a = a.size() - i, left_of_b = b.size() - j;
  return left_of_a != left_of_b ? left_of_a < left_of_b : a < b;
}

bool has_movie_ending(const std::string& path) {
  static constexpr std::array<std::string_view, 6> kMovies = {".mp4", ".mkv", ".webm", ".avi", ".mpg", ".mov"};
  return std::find(kMovies.begin(), kMovies.end(), fs::path(path).extension().string()) != kMovies.end();
}

static bool is_image_or_movie(const std::string& path) {
  if (path.ends_with(".rgba")) return false;
  const ImageReader reader = image_kind_of_file(path.c_str()).reader;
  return reader == ImageReader::kMovie ? has_movie_ending(path) : reader != ImageReader::kRefused;
}

Result<std::vector<std::string>> files_in_order(const std::string& folder,
                                                const std::function<bool(const std::string&)>& wanted) {
  std::vector<std::string> files;
  std::error_code code;
  for (auto entry = fs::directory_iterator(folder, code); !code && entry != fs::directory_iterator();
       entry.increment(code)) {
    const std::string file = entry->path().string();
    std::error_code kind;
    if (!entry->is_regular_file(kind) || entry->path().filename().string().starts_with(".")) continue;
    if (wanted(file)) files.push_back(file);
  }
  if (code) return Error{ErrorKind::kFile, folder + ": " + code.message()};
  std::sort(files.begin(), files.end(), comes_before);
  return files;
}

Result<std::vector<std::string>> expand_image_folders(const std::vector<std::string>& paths,
                                                      const std::function<bool(const std::string&)>& is_raw) {
  std::vector<std::string> out;
  for (const std::string& path : paths) {
    std::error_code code;
    if (path == "-" || !fs::is_directory(path, code)) {
      out.push_back(path);
      continue;
    }
    const auto files = files_in_order(
        path, [&](const std::string& file) { return is_raw(file) || is_image_or_movie(file); });
    if (!files) return files.error();
    if (files->empty())
      return Error{ErrorKind::kFile, path + ": is a folder without images (raw .rgba files need --size WxH)" +
                                         verb_hint(path, "frames")};
    out.insert(out.end(), files->begin(), files->end());
  }
  return out;
}

}  // namespace tilepress
