// Append file: a file of a run that grows by whole records, in a process that may close any descriptor.
#pragma once

#include <sys/types.h>

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// The program under the shim may close any descriptor and get its number for a file of its own. So append()
/// checks that the descriptor is still this file, and opens the file again if not. The number lies above
/// those that programs use: a program that has closed its standard error does not write to this file.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();
  /// Makes a new file that begins with `header`. On failure no new file is left. kExists: the name is taken.
  Result<void> create(const std::string& path, const std::string& header);
  /// Appends all of `record` or nothing: what a full disk lets through is cut off again.
  Result<void> append(const std::string& record);
  bool is_open() const { return fd_ >= 0; }
  /// Takes the run lock (run_lock.h) with this file, and again whenever the file is opened again.
  void hold_lock();
  /// Releases the part of the run lock that stands for the program.
  void release_lock_of_program();

 private:
  bool is_this_file() const;
  Result<void> open_again();
  std::string path_;
  int fd_ = -1;
  bool holds_lock_ = false;
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

}  // namespace tilepress
