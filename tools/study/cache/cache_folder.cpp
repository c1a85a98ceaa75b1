// Cache folder: the time of the last change of a file is the time of its last use.
#include "study/cache/cache_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "study/cache/cache_lock.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPartialMark = ".frames.partial-";
constexpr const char* kLockMark = ".frames.lock";
/// A writer of another host adds to its file more often than this.
constexpr std::chrono::hours kDeadWriter{24};

const int64_t process_began = std::time(nullptr);

}  // namespace

std::string default_cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return std::string(cache) + "/tilepress/frames";
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr && home[0] == '/' ? home : "/tmp") + "/.cache/tilepress/frames";
}

std::string cache_path(const std::string& folder, const std::string& key) {
  return folder + "/" + key + kCacheSuffix;
}

Result<std::vector<CacheFile>> cache_files(const std::string& folder) {
  std::vector<CacheFile> files;
  std::error_code code;
  fs::directory_iterator entries(folder, code);
  if (code == std::errc::no_such_file_or_directory) return files;
  for (; !code && entries != fs::directory_iterator(); entries.increment(code)) {
    struct stat status {};
    if (entries->path().extension() != kCacheSuffix || stat(entries->path().c_str(), &status) != 0 ||
        !S_ISREG(status.st_mode))
      continue;
    files.push_back({entries->path().string(), static_cast<uint64_t>(status.st_size), status.st_mtim.tv_sec});
  }
  if (code) return Error{ErrorKind::kFile, folder + ": " + code.message()};
  std::sort(files.begin(), files.end(), [](const CacheFile& a, const CacheFile& b) {
    return a.used_s != b.used_s ? a.used_s > b.used_s : a.path < b.path;
  });
  return files;
}

void note_use(const std::string& path) {
  utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

std::vector<CacheFile> surplus(const std::vector<CacheFile>& files, uint64_t keep_bytes) {
  uint64_t sum = 0;
  std::vector<CacheFile> out;
  for (const CacheFile& file : files) {
    sum += file.bytes;
    if (sum > keep_bytes) out.push_back(file);
  }
  return out;
}

void apply_size_limit(const std::string& folder, uint64_t limit_bytes) {
  const auto files = cache_files(folder);
  if (!files) return;
  const int64_t recent =
      std::min<int64_t>(process_began, std::time(nullptr) - std::chrono::seconds(kRecentUse).count());
  std::error_code code;
  for (const CacheFile& file : surplus(*files, limit_bytes))
    if (file.used_s < recent) fs::remove(file.path, code);
}

std::vector<std::string> leftovers(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string path = entry.path().string(), name = entry.path().filename().string();
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) continue;
    const bool old = status.st_mtim.tv_sec + std::chrono::seconds(kDeadWriter).count() < std::time(nullptr);
    const size_t partial = name.find(kPartialMark), lock = name.find(kLockMark);
    if (lock != std::string::npos && (old || is_lock_of_dead_process(path))) out.push_back(path);
    // The lock of the same key says whether the writer lives.
    if (partial != std::string::npos &&
        (old || !fs::exists(folder + "/" + name.substr(0, partial) + kLockMark, code) ||
         is_lock_of_dead_process(folder + "/" + name.substr(0, partial) + kLockMark)))
      out.push_back(path);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace tilepress
