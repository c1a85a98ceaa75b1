// Trace input: the bytes of a trace file, on disk or in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

class TraceInput {
 public:
  explicit TraceInput(std::span<const uint8_t> memory) : memory_(memory), size_(memory.size()) {}
  /// Opens a regular file. Error: kFile, or kUnsupported if the file is not a regular one.
  static Result<TraceInput> open(const std::string& path);
  TraceInput(TraceInput&& other) noexcept;
  TraceInput& operator=(TraceInput&&) = delete;
  ~TraceInput();

  uint64_t size() const { return size_; }
  uint64_t position() const { return position_; }
  /// Reads `to.size()` bytes, and fewer only at the end of the file. Throws TraceFault if the disk fails.
  size_t read(std::span<uint8_t> to);
  void rewind();

 private:
  TraceInput(int fd, uint64_t size) : fd_(fd), size_(size) {}

  std::span<const uint8_t> memory_;
  int fd_ = -1;
  uint64_t size_ = 0, position_ = 0;
};

}  // namespace tilepress
