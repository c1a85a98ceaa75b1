// Cache folder: its files, when they were last used, and which of them go.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

constexpr const char* kCacheSuffix = ".frames";

/// $XDG_CACHE_HOME/tilepress/frames, or ~/.cache/tilepress/frames.
std::string default_cache_folder();
std::string cache_path(const std::string& folder, const std::string& key);

/// A cache file without its content.
struct CacheFile {
  std::string path;
  uint64_t bytes = 0;
  int64_t used_s = 0;  ///< last use, seconds since 1970
};

/// The cache files of the folder, the most recently used first. Error: kFile, the folder first. A folder that
/// does not exist has no files.
Result<std::vector<CacheFile>> cache_files(const std::string& folder);

/// Notes that the file is used now, as far as the caller may write it.
void note_use(const std::string& path);

/// Files used within this time, or since this process began, are never removed for the size limit.
constexpr std::chrono::minutes kRecentUse{60};

/// Of `files`, those that must go so that at most `keep_bytes` are left: the least recently used ones.
std::vector<CacheFile> surplus(const std::vector<CacheFile>& files, uint64_t keep_bytes);

/// Removes the surplus over `limit_bytes`, except files used lately.
void apply_size_limit(const std::string& folder, uint64_t limit_bytes);

/// What dead processes left: files of writers, and locks.
std::vector<std::string> leftovers(const std::string& folder);

}  // namespace tilepress
