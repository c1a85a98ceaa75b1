// Output file: what a verb writes to the FILE of -o, whole or not at all. Error texts begin with the file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "streams/ending_signals.h"
#include "tilepress/result.h"

namespace tilepress {

/// A file that gets its name once it is whole. A device or FIFO is written directly.
class PendingFile {
 public:
  PendingFile() = default;
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();  ///< removes the file, unless commit() was called
  /// Makes an empty file beside `path`. Fails with kExists if the file exists and `replace` is false.
  Result<void> begin(const std::string& path, bool replace);
  const std::string& path() const { return work_path_; }  ///< write here
  /// Call when everything is written and closed.
  Result<void> commit();

 private:
  std::string final_path_, work_path_;
  std::optional<UnfinishedFile> unfinished_;  ///< none for a device
};

/// Text for a PendingFile, or for standard output if the path is "-".
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  Result<void> open(const std::string& path, bool replace);
  bool is_open() const { return fd_ >= 0 || to_stdout_; }
  /// commit() returns the first error.
  void write(std::string_view text);
  /// Fails if not everything was written.
  Result<void> commit();

 private:
  void flush();
  PendingFile pending_;
  std::string path_, buffer_;
  int fd_ = -1;
  int first_error_ = 0;
  bool to_stdout_ = false;
};

/// Writes all of `text` to `path` as OutputFile does.
Result<void> write_whole_file(const std::string& path, std::string_view text, bool replace);

}  // namespace tilepress
