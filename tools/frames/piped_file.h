// Piped file: what a pipe delivers, read once and kept where it can be read again.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <string>

namespace tilepress {

/// Reads until `size` bytes or the end; the bytes read, or -1. Gives up once a signal asks the verb to end.
ssize_t read_fully(int fd, std::byte* to, size_t size);

/// An open pipe, FIFO or device. Closed with the last owner.
class Pipe {
 public:
  /// Waits for a writer. Null and one line in `error`. "-" is standard input, which stays open.
  static std::shared_ptr<Pipe> open(const std::string& path, std::string& error);
  explicit Pipe(int fd) : fd_(fd) {}
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe();

  /// The first `size` bytes, fewer at the end; read() returns them again.
  const std::string& peek(size_t size);
  /// As read_fully().
  ssize_t read(std::byte* to, size_t size);
  int fd() const { return fd_; }

 private:
  const int fd_;
  std::string peeked_;
};

/// Copies the rest of a pipe to a file without a name; its path is that of `fd()` of the result under /proc.
/// Null and a reason.
std::shared_ptr<Pipe> copy_to_file(Pipe& from, std::string& reason);
std::string path_of(const Pipe& file);

}  // namespace tilepress
