// Piped file: what a pipe delivers, read once and kept where it can be read again. Error texts do not name
// the pipe.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Reads until `size` bytes or the end. Returns the bytes read. Fails once a signal asks the verb to end.
Result<size_t> read_fully(int fd, std::byte* to, size_t size);

/// An open pipe, FIFO or device. The last owner closes it.
class Pipe {
 public:
  /// Waits for a writer. "-" is standard input, which stays open.
  static Result<std::shared_ptr<Pipe>> open(const std::string& path);
  explicit Pipe(int fd) : fd_(fd) {}
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe();

  /// The first `size` bytes, fewer at the end. read() returns them again.
  const std::string& peek(size_t size);
  /// Works as read_fully().
  Result<size_t> read(std::byte* to, size_t size);
  /// A path under /proc that opens the same file.
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  const int fd_;
  std::string peeked_;
};

/// Copies the rest of a pipe to a file without a name.
Result<std::shared_ptr<Pipe>> copy_to_file(Pipe& from);

}  // namespace tilepress
