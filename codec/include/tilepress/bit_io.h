// Bit writer and reader: most significant bit first, bounded buffers, never past the end.
#pragma once

#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>

namespace tilepress {

/// Most bits of one put() or get(): one call must fit beside the up to 7 bits left in the 64-bit accumulator.
constexpr uint32_t kMaxBitsPerCall = 57;

/// Writes bits into a buffer the caller owns. Bits that do not fit are counted and lost: check overflowed().
class BitWriter {
 public:
  explicit BitWriter(std::span<uint8_t> buffer) : buffer_(buffer) {}

  /// Appends the low `count` bits of `value`, highest first. count ≤ kMaxBitsPerCall; higher bits of value
  /// are 0.
  void put(uint64_t value, uint32_t count) {
    assert(count <= kMaxBitsPerCall && (count == 64 || value >> count == 0));
    accumulator_ = (accumulator_ << count) | value;
    pending_ += count;
    bit_count_ += count;
    while (pending_ >= 8) {
      pending_ -= 8;
      store(static_cast<uint8_t>(accumulator_ >> pending_));
    }
  }
  /// Appends `count` one-bits followed by a zero-bit.
  void put_unary(uint32_t count) {
    for (; count >= 32; count -= 32) put(0xFFFFFFFFu, 32);
    put((uint64_t{1} << (count + 1)) - 2, count + 1);
  }
  /// Appends zero-bits until `bits` are written in all.
  void pad_to(uint64_t bits) {
    while (bit_count_ < bits) put(0, static_cast<uint32_t>(bits - bit_count_ < 32 ? bits - bit_count_ : 32));
  }
  /// Writes out the bits of the last, partial byte, zero-filled. Call once, after the last put().
  void flush() {
    if (pending_ > 0) store(static_cast<uint8_t>(accumulator_ << (8 - pending_)));
    pending_ = 0;
  }
  uint64_t bit_count() const { return bit_count_; }
  bool overflowed() const { return (bit_count_ + 7) / 8 > buffer_.size(); }

 private:
  void store(uint8_t byte) {
    if (position_ < buffer_.size()) buffer_[position_] = byte;
    ++position_;
  }
  std::span<uint8_t> buffer_;
  size_t position_ = 0;
  uint64_t accumulator_ = 0;
  uint32_t pending_ = 0;
  uint64_t bit_count_ = 0;
};

/// Reads what BitWriter wrote. Past the end it returns zero-bits and remembers: check overran().
class BitReader {
 public:
  explicit BitReader(std::span<const uint8_t> buffer) : BitReader(buffer, uint64_t{buffer.size()} * 8) {}
  BitReader(std::span<const uint8_t> buffer, uint64_t bit_count)
      : buffer_(buffer), end_(bit_count < buffer.size() * 8 ? bit_count : buffer.size() * 8) {}

  /// Next `count` bits, highest first. count ≤ kMaxBitsPerCall.
  uint64_t get(uint32_t count) {
    assert(count <= kMaxBitsPerCall);
    uint64_t value = 0;
    uint32_t left = count;
    while (left > 0) {
      const uint32_t in_byte = static_cast<uint32_t>(position_ & 7);
      const uint32_t take = left < 8 - in_byte ? left : 8 - in_byte;
      uint32_t bits = 0;
      if (position_ < end_) bits = (buffer_[position_ >> 3] >> (8 - in_byte - take)) & ((1u << take) - 1);
      if (position_ + take > end_ && position_ < end_) {  // the end lies inside the byte
        const uint32_t beyond = static_cast<uint32_t>(position_ + take - end_);
        bits = bits >> beyond << beyond;
      }
      value = (value << take) | bits;
      position_ += take;
      left -= take;
    }
    return value;
  }
  /// Number of one-bits before the next zero-bit, which is consumed; gives up and returns limit + 1 past
  /// `limit`.
  uint32_t get_unary(uint32_t limit) {
    uint32_t count = 0;
    while (get(1) != 0)
      if (++count > limit) return count;
    return count;
  }
  void skip(uint64_t count) { position_ += count; }
  uint64_t position() const { return position_; }
  bool overran() const { return position_ > end_; }

 private:
  std::span<const uint8_t> buffer_;
  uint64_t end_;
  uint64_t position_ = 0;
};

}  // namespace tilepress
