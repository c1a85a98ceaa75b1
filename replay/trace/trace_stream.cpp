// Trace stream: one piece of the container at a time.
#include "trace_stream.h"

#include <algorithm>

namespace tilepress {

bool TraceStream::refill() {
  piece_offset_ += static_cast<uint64_t>(piece_end_ - piece_begin_);
  piece_begin_ = piece_end_;  // next() may throw, and offset() is read after that
  const std::span<const uint8_t> piece = container_.next();
  piece_begin_ = at_ = piece.data();
  piece_end_ = piece.data() + piece.size();
  if (!piece.empty()) {
    if (piece_offset_ + piece.size() > max_bytes_)
      fail_corrupt("unpacks to more than " + std::to_string(max_bytes_) +
                   " bytes, far more than its size justifies");
    return true;
  }
  return false;
}

void TraceStream::stop_inside() {
  fail_truncated("the stream ends inside an event");
}

uint64_t TraceStream::read_long_uint(uint8_t first) {
  uint64_t value = first & 0x7f;
  for (int shift = 7; shift < 64; shift += 7) {
    const uint8_t byte = read_byte();
    value |= static_cast<uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  fail_corrupt("an integer is longer than 64 bits");
}

std::string TraceStream::read_string(uint64_t kept_bytes) {
  const uint64_t length = read_uint();
  const uint64_t kept = std::min(length, kept_bytes);
  std::string text;
  while (text.size() < kept) {
    if (at_ == piece_end_ && !refill()) stop_inside();
    const uint64_t step = std::min<uint64_t>(kept - text.size(), static_cast<uint64_t>(piece_end_ - at_));
    text.append(reinterpret_cast<const char*>(at_), step);
    at_ += step;
  }
  skip(length - kept);
  return text;
}

void TraceStream::skip(uint64_t bytes) {
  while (bytes > 0) {
    if (at_ == piece_end_ && !refill()) stop_inside();
    const uint64_t step = std::min<uint64_t>(bytes, static_cast<uint64_t>(piece_end_ - at_));
    at_ += step;
    bytes -= step;
  }
}

}  // namespace tilepress
