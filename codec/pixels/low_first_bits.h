// Low-first bits: one memory line, filled from the low end of each byte, as GPU formats number their bits.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "tilepress/bit_io.h"

namespace tilepress {

/// A line of up to 64 bytes. Bit i of the line is bit i % 8 of byte i / 8. A line is either filled with put()
/// or read with get(), from bit 0 on.
class LowFirstBits {
 public:
  static constexpr uint32_t kMostBits = 512;

  /// Reads a line of `bytes` bytes, a multiple of 8. Check in.overran().
  static LowFirstBits read(BitReader& in, uint32_t bytes) {
    LowFirstBits line;
    for (uint32_t i = 0; i < bytes / 8; ++i) line.words_[i] = __builtin_bswap64(in.get64());
    return line;
  }
  /// Appends the first `bytes` bytes to `out`, a multiple of 8.
  void write(BitWriter& out, uint32_t bytes) const {
    assert(position_ <= bytes * 8);
    for (uint32_t i = 0; i < bytes / 8; ++i) out.put64(__builtin_bswap64(words_[i]));
  }

  /// Appends the low `count` bits of `value`, lowest first. count ≤ 32, the other bits are 0, and the line
  /// has room.
  void put(uint32_t value, uint32_t count) {
    assert(count <= 32 && uint64_t{value} >> count == 0 && position_ + count <= kMostBits);
    if (count == 0) return;
    const uint32_t word = position_ / 64, used = position_ % 64;
    words_[word] |= uint64_t{value} << used;
    if (used + count > 64) words_[word + 1] |= uint64_t{value} >> (64 - used);
    position_ += count;
  }
  /// Returns the next `count` bits, lowest first. count ≤ 32. Returns 0 if the line ends before them: check
  /// overran().
  uint32_t get(uint32_t count) {
    assert(count <= 32);
    const uint32_t word = position_ / 64, used = position_ % 64;
    position_ += count;
    if (position_ > kMostBits || count == 0) return 0;
    uint64_t value = words_[word] >> used;
    if (used + count > 64) value |= words_[word + 1] << (64 - used);
    return static_cast<uint32_t>(value & ((uint64_t{1} << count) - 1));
  }
  void skip(uint32_t count) { position_ += count; }
  bool overran() const { return position_ > kMostBits; }

 private:
  std::array<uint64_t, kMostBits / 64> words_{};
  uint32_t position_ = 0;  ///< bits put, or read
};

}  // namespace tilepress
