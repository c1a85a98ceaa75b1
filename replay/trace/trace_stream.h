// Trace stream: bytes, integers and strings from a container, and the offset of each.
#pragma once

#include <cstdint>
#include <string>

#include "trace_container.h"

namespace tilepress {

/// Every read throws TraceFault where the stream is cut off or damaged.
class TraceStream {
 public:
  TraceStream(TraceContainer& container, uint64_t max_bytes) : container_(container), max_bytes_(max_bytes) {}

  /// Bytes consumed so far.
  uint64_t offset() const { return piece_offset_ + static_cast<uint64_t>(at_ - piece_begin_); }
  /// Returns true at the regular end of the stream.
  bool at_end() { return at_ == piece_end_ && !refill(); }

  uint8_t read_byte() {
    if (at_ == piece_end_ && !refill()) stop_inside();
    return *at_++;
  }
  /// 7 bits a byte, the lowest first. Bit 7 is set if another byte follows.
  uint64_t read_uint() {
    const uint8_t first = read_byte();
    return first < 0x80 ? first : read_long_uint(first);
  }
  /// Reads a length and as many bytes. Returns the first `kept_bytes` of them and skips the rest.
  std::string read_string(uint64_t kept_bytes);
  void skip_string() { skip(read_uint()); }
  void skip(uint64_t bytes);

 private:
  bool refill();
  uint64_t read_long_uint(uint8_t first);
  [[noreturn]] void stop_inside();

  TraceContainer& container_;
  uint64_t max_bytes_;
  uint64_t piece_offset_ = 0;
  const uint8_t* piece_begin_ = nullptr;
  const uint8_t* piece_end_ = nullptr;
  const uint8_t* at_ = nullptr;
};

}  // namespace tilepress
