// Cache commands: a table of files, and their removal.
#include "study/cache/cache_commands.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "exit_status.h"
#include "printable.h"
#include "streams/messages.h"
#include "study/cache/cache_folder.h"
#include "study/cache/frame_cache.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

std::string megabytes(uint64_t bytes) {
  return fmt::format("{:.1f}", static_cast<double>(bytes) / 1e6);
}

std::string day(int64_t seconds) {
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

/// Removes the file and prints a line. Returns false if it stays.
bool remove_file(const std::string& path, uint64_t bytes, const std::string& why, bool dry_run) {
  std::error_code code;
  if (!dry_run && (!fs::remove(path, code) || code)) {
    say(MessageLevel::kError, path + ": " + code.message());
    return false;
  }
  std::printf("%s %s (%s MB, %s)\n", dry_run ? "would remove" : "removed", printable(path).c_str(),
              megabytes(bytes).c_str(), why.c_str());
  return true;
}

}  // namespace

int list_cache(const std::string& folder_or_default) {
  const std::string folder = folder_or_default.empty() ? default_cache_folder() : folder_or_default;
  const auto files = cache_files(folder);
  if (!files) return fail(kExitFailed, files.error());
  uint64_t sum = 0;
  int status = kExitDone;
  std::string rows;
  for (const CacheFile& file : *files) {
    sum += file.bytes;
    FrameCacheReader reader;
    if (const auto opened = reader.open(file.path); !opened) {
      status = fail(kExitFailed, opened.error());
      continue;
    }
    const CacheOrigin& origin = reader.origin();
    rows += fmt::format("{:<16}  {:>6}  {:>9}  {:>9}  {:<16}  {}  {}{}\n",
                        fs::path(file.path).stem().string().substr(0, 16), reader.frame_count(),
                        megabytes(reader.raw_bytes()), megabytes(file.bytes), day(file.used_s),
                        printable(origin.input), printable(origin.gl_renderer),
                        origin.reason.empty() ? "" : "  (" + printable(origin.reason) + ")");
  }
  if (!rows.empty())
    std::printf("%-16s  %6s  %9s  %9s  %-16s  %s\n%s", "key", "frames", "raw MB", "file MB", "last use, UTC",
                "trace  renderer", rows.c_str());
  std::printf("%s: %zu %s, %s MB\n", printable(folder).c_str(), files->size(),
              files->size() == 1 ? "file" : "files", megabytes(sum).c_str());
  return status;
}

int prune_cache(const std::string& folder_or_default, const PruneOptions& options) {
  const std::string folder = folder_or_default.empty() ? default_cache_folder() : folder_or_default;
  const auto files = cache_files(folder);
  if (!files) return fail(kExitFailed, files.error());
  bool good = true;
  std::vector<CacheFile> readable;
  for (const CacheFile& file : *files) {
    FrameCacheReader reader;
    if (const auto opened = reader.open(file.path); opened)
      readable.push_back(file);
    else
      good &= remove_file(file.path, file.bytes, "cannot be read", options.dry_run);
  }
  std::error_code code;
  for (const std::string& path : leftovers(folder))
    good &= remove_file(path, fs::file_size(path, code), "left by a process that died", options.dry_run);
  for (const CacheFile& file : surplus(readable, options.keep_bytes))
    good &= remove_file(file.path, file.bytes, "last used " + day(file.used_s), options.dry_run);
  return good ? kExitDone : kExitFailed;
}

}  // namespace tilepress
