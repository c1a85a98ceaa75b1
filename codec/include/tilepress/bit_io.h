// Bit writer and reader: most significant bit first, bounded buffers, never past the end.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>

namespace tilepress {

/// Most bits of one put() or get(). A get() reads 64 bits at a byte boundary, and up to 7 of them lie before
/// its own.
constexpr uint32_t kMaxBitsPerCall = 57;

namespace bit_io {
constexpr uint64_t big_endian(uint64_t word) {
  if constexpr (std::endian::native == std::endian::little) return __builtin_bswap64(word);
  return word;
}
}  // namespace bit_io

/// Writes bits into a buffer that the caller owns. Counts and drops bits that do not fit: check overflowed().
class BitWriter {
 public:
  explicit BitWriter(std::span<uint8_t> buffer) : buffer_(buffer) {}

  /// Appends the low `count` bits of `value`, highest first. count ≤ kMaxBitsPerCall, and the other bits are
  /// 0.
  void put(uint64_t value, uint32_t count) {
    assert(count <= kMaxBitsPerCall && value >> count == 0);
    const uint32_t free = 64 - pending_;  // 1..64
    if (count < free) {
      accumulator_ |= value << (free - 1 - count) << 1;  // in two steps: free - count may be 64
      pending_ += count;
      return;
    }
    store(accumulator_ | value >> (count - free));
    pending_ = count - free;
    accumulator_ = pending_ == 0 ? 0 : value << (64 - pending_);
  }
  /// Appends all 64 bits of `value`.
  void put64(uint64_t value) {
    store(accumulator_ | value >> pending_);
    accumulator_ = pending_ == 0 ? 0 : value << (64 - pending_);
  }
  /// Returns the next `bytes` bytes, for callers that write the bits themselves and report the count with
  /// wrote(). Returns null if bits are held back or the bytes do not fit.
  uint8_t* at_byte(size_t bytes) {
    const bool fit = position_ <= buffer_.size() && bytes <= buffer_.size() - position_;
    return pending_ == 0 && fit ? buffer_.data() + position_ : nullptr;
  }
  /// Appends `bits` bits that the caller wrote to at_byte(). The rest of their last byte is 0.
  void wrote(uint64_t bits) {
    position_ += bits / 8;
    pending_ = static_cast<uint32_t>(bits % 8);
    accumulator_ = pending_ == 0 ? 0 : uint64_t{buffer_[position_]} << 56;
  }
  /// Appends zero-bits up to `bits` bits in total.
  void pad_to(uint64_t bits) {
    for (uint64_t now = bit_count(); now < bits; now = bit_count())
      put(0, static_cast<uint32_t>(bits - now < 32 ? bits - now : 32));
  }
  /// Stores the bits still held back and fills the last byte with zeros. May set up to seven bytes behind it
  /// to zero, within the buffer. Call it once, after the last put().
  void flush() {
    if (pending_ > 0) store(accumulator_);
    if (pending_ > 0) position_ -= 8;
  }
  uint64_t bit_count() const { return uint64_t{position_} * 8 + pending_; }
  bool overflowed() const { return (bit_count() + 7) / 8 > buffer_.size(); }

 private:
  void store(uint64_t word) {
    if (position_ + 8 <= buffer_.size()) {
      const uint64_t bytes = bit_io::big_endian(word);
      std::memcpy(&buffer_[position_], &bytes, 8);
    } else {
      for (uint32_t i = 0; i < 8 && position_ + i < buffer_.size(); ++i)
        buffer_[position_ + i] = static_cast<uint8_t>(word >> (56 - 8 * i));
    }
    position_ += 8;
  }
  std::span<uint8_t> buffer_;
  size_t position_ = 0;       ///< bytes stored or dropped
  uint64_t accumulator_ = 0;  ///< bits not stored yet, from the top bit down
  uint32_t pending_ = 0;      ///< their number, 0..63
};

/// Reads what BitWriter wrote. Returns zero-bits past the end: check overran().
class BitReader {
 public:
  explicit BitReader(std::span<const uint8_t> buffer) : BitReader(buffer, uint64_t{buffer.size()} * 8) {}
  BitReader(std::span<const uint8_t> buffer, uint64_t bit_count)
      : buffer_(buffer), end_(bit_count < buffer.size() * 8 ? bit_count : buffer.size() * 8) {}

  /// Returns the next `count` bits, highest first. count ≤ kMaxBitsPerCall.
  uint64_t get(uint32_t count) {
    assert(count <= kMaxBitsPerCall);
    const uint64_t window = peek();
    position_ += count;
    return count == 0 ? 0 : window >> (64 - count);
  }
  /// Returns the next 64 bits, highest first.
  uint64_t get64() {
    const uint64_t byte = position_ >> 3;
    if (byte + 9 > buffer_.size() || position_ + 64 > end_) {
      const uint64_t upper = get(32);
      return upper << 32 | get(32);
    }
    uint64_t word;
    std::memcpy(&word, &buffer_[byte], 8);
    const uint32_t used = position_ & 7;
    position_ += 64;
    return bit_io::big_endian(word) << used | buffer_[byte + 8] >> (8 - used);
  }
  /// Consumes one-bits and the next zero-bit, and returns the number of one-bits. Stops early after more than
  /// `limit` one-bits.
  uint32_t get_unary(uint32_t limit) {
    uint32_t count = 0;
    for (;;) {
      const auto ones =
          static_cast<uint32_t>(std::countl_one(peek() | 0x7F));  // peek() returns at least 57 bits
      if (ones < kMaxBitsPerCall) {
        position_ += ones + 1;
        return count + ones;
      }
      position_ += kMaxBitsPerCall;
      count += kMaxBitsPerCall;
      if (count > limit) return count;
    }
  }
  void skip(uint64_t count) { position_ += count; }
  /// Returns the next `bytes` bytes without consuming them. Returns null if they do not begin at a byte or
  /// are not all there.
  const uint8_t* at_byte(size_t bytes) const {
    const bool there = position_ % 8 == 0 && position_ <= end_ && bytes * 8 <= end_ - position_;
    return there ? buffer_.data() + position_ / 8 : nullptr;
  }
  uint64_t position() const { return position_; }
  bool overran() const { return position_ > end_; }
  /// Returns the next 57 bits or more at the top of a word, zeros past the end, without consuming them.
  uint64_t peek() const {
    const uint64_t byte = position_ >> 3;
    uint64_t word = 0;
    if (byte + 8 <= buffer_.size()) {
      std::memcpy(&word, &buffer_[byte], 8);
      word = bit_io::big_endian(word);
    } else {
      for (uint32_t i = 0; i < 8 && byte + i < buffer_.size(); ++i)
        word |= uint64_t{buffer_[byte + i]} << (56 - 8 * i);
    }
    word <<= position_ & 7;
    if (position_ + 64 > end_) {
      if (position_ >= end_) return 0;
      word &= ~uint64_t{0} << (64 - (end_ - position_));
    }
    return word;
  }

 private:
  std::span<const uint8_t> buffer_;
  uint64_t end_;
  uint64_t position_ = 0;
};

}  // namespace tilepress
