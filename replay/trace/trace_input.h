// Trace input: the bytes of a trace file, from disk or from memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace tilepress {

class TraceInput {
 public:
  explicit TraceInput(std::span<const uint8_t> memory) : memory_(memory), size_(memory.size()) {}
  /// Opens a regular file; on failure is_open() is false and `error` says why in one line.
  TraceInput(const std::string& path, std::string& error);
  TraceInput(const TraceInput&) = delete;
  TraceInput& operator=(const TraceInput&) = delete;
  ~TraceInput();

  bool is_open() const { return fd_ >= 0 || memory_.data() != nullptr || size_ == 0; }
  uint64_t size() const { return size_; }
  uint64_t position() const { return position_; }
  /// Reads up to `to.size()` bytes; fewer only at the end of the file. Throws TraceFault if the disk fails.
  size_t read(std::span<uint8_t> to);
  void rewind();

 private:
  std::span<const uint8_t> memory_;
  int fd_ = -1;
  uint64_t size_ = 0, position_ = 0;
};

}  // namespace tilepress
