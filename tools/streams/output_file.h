// Output file: what a verb writes to the FILE of -o, whole or not at all.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "streams/ending_signals.h"

namespace tilepress {

/// Where to write a file that gets its name once it is whole. A device or FIFO is written directly.
class PendingFile {
 public:
  PendingFile() = default;
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();  ///< removes the file, unless commit() was called
  /// Makes an empty file beside `path`. An existing file is replaced only with `replace`. Returns false and
  /// one line in `error` on failure.
  bool begin(const std::string& path, bool replace, std::string& error);
  const std::string& path() const { return work_path_; }  ///< write here
  /// Call when everything is written and closed. Returns false and one line in `error` on failure.
  bool commit(std::string& error);

 private:
  std::string final_path_, work_path_;
  std::optional<UnfinishedFile> unfinished_;  ///< none for a device
};

/// Text for a PendingFile, or for standard output if the path is "-".
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  bool open(const std::string& path, bool replace, std::string& error);
  bool is_open() const { return fd_ >= 0 || to_stdout_; }
  /// An error is kept until commit().
  void write(std::string_view text);
  /// Returns false and one line in `error` ("FILE: reason") if not everything was written.
  bool commit(std::string& error);

 private:
  void flush();
  PendingFile pending_;
  std::string path_, buffer_;
  int fd_ = -1;
  int first_error_ = 0;
  bool to_stdout_ = false;
};

/// Writes all of `text` to `path` as OutputFile does.
bool write_whole_file(const std::string& path, std::string_view text, bool replace, std::string& error);

}  // namespace tilepress
