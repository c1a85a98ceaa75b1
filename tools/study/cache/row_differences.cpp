// Row differences: 16 bytes at a time. Compilers know these vectors on every processor.
#include "study/cache/row_differences.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tilepress {
namespace {

using Bytes16 [[gnu::vector_size(16)]] = uint8_t;

Bytes16 load(const std::byte* from) {
  Bytes16 out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

std::byte byte_of(int value) {
  return static_cast<std::byte>(value & 0xFF);
}

/// Copies the bytes of [begin, end) that lie in the top row, and returns the first one below.
size_t copy_top_row(const std::byte* from, size_t pitch, size_t begin, size_t end, std::byte* to) {
  const size_t below = std::min(std::max(begin, pitch), end);
  std::memcpy(to, from, below - begin);
  return below;
}

}  // namespace

void take_row_differences(const std::byte* frame, size_t pitch, size_t begin, size_t end, std::byte* out) {
  size_t at = copy_top_row(frame + begin, pitch, begin, end, out);
  out += at - begin;
  for (; at + sizeof(Bytes16) <= end; at += sizeof(Bytes16), out += sizeof(Bytes16)) {
    const Bytes16 difference = load(frame + at) - load(frame + at - pitch);
    std::memcpy(out, &difference, sizeof difference);
  }
  for (; at < end; ++at) *out++ = byte_of(static_cast<int>(frame[at]) - static_cast<int>(frame[at - pitch]));
}

void add_row_differences(const std::byte* in, size_t pitch, size_t begin, size_t end, std::byte* frame) {
  size_t at = copy_top_row(in, pitch, begin, end, frame + begin);
  in += at - begin;
  // In a narrower row the byte above is in the vector that is being made.
  for (; pitch >= sizeof(Bytes16) && at + sizeof(Bytes16) <= end;
       at += sizeof(Bytes16), in += sizeof(Bytes16)) {
    const Bytes16 sum = load(in) + load(frame + at - pitch);
    std::memcpy(frame + at, &sum, sizeof sum);
  }
  for (; at < end; ++at) frame[at] = byte_of(static_cast<int>(*in++) + static_cast<int>(frame[at - pitch]));
}

}  // namespace tilepress
