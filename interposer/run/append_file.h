// Append file: a file of a run that grows by whole records, inside a process whose descriptors are not ours
// to rule.
#pragma once

#include <sys/types.h>

#include <string>

namespace tilepress {

/// The program under the shim may close any descriptor and get its number for a file of its own: before each
/// record the descriptor is checked to be still this file, and opened anew if not. The number lies above
/// those programs use, so that a program which has closed its standard error does not write it here.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();
  /// Makes a new file that begins with `header`. False, with errno set and no file left, if it exists or
  /// cannot be made.
  bool create(const std::string& path, const std::string& header);
  /// Appends all of `record` or nothing: what a full disk lets through is cut off again. False with errno
  /// set.
  bool append(const std::string& record);
  bool is_open() const { return fd_ >= 0; }
  /// Takes the run lock (run_lock.h) with this file, and again whenever it has to be opened anew.
  void hold_lock();
  /// Releases the part of the run lock that stands for the program.
  void release_lock_of_program();

 private:
  bool is_this_file() const;
  std::string path_;
  int fd_ = -1;
  bool holds_lock_ = false;
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

}  // namespace tilepress
