// Bit string: the bits that a scheme in Python writes or reads. It has memory of its own, so that Python may
// keep it longer than a block lasts.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/bit_io.h"

namespace tilepress::python {

/// Appends bits, the highest of a value first.
class BitSink {
 public:
  /// `value` fits into `count` bits, at most 64.
  void put(uint64_t value, uint32_t count) {
    for (uint32_t i = count; i > 0; --i, ++bit_count_) {
      if (bit_count_ % 8 == 0) bytes_.push_back(0);
      bytes_.back() |= static_cast<uint8_t>((value >> (i - 1) & 1) << (7 - bit_count_ % 8));
    }
  }
  uint64_t bit_count() const { return bit_count_; }
  const std::vector<uint8_t>& bytes() const { return bytes_; }
  void write_to(BitWriter& out) const {
    BitReader bits(bytes_, bit_count_);
    for (uint64_t left = bit_count_; left > 0;) {
      const auto take = static_cast<uint32_t>(left < 32 ? left : 32);
      out.put(bits.get(take), take);
      left -= take;
    }
  }

 private:
  std::vector<uint8_t> bytes_;
  uint64_t bit_count_ = 0;
};

/// Reads up to `most` bits of another reader from a copy, and leaves that reader where it is.
class BitSource {
 public:
  BitSource(BitReader from, uint64_t most) : bytes_(copied(from, most)), reader_(bytes_) {}
  // The reader refers to the bytes.
  BitSource(const BitSource&) = delete;
  BitSource& operator=(const BitSource&) = delete;

  uint64_t get(uint32_t count) {
    if (count <= 32) return reader_.get(count);
    const uint64_t upper = reader_.get(count - 32);
    return upper << 32 | reader_.get(32);
  }
  uint64_t position() const { return reader_.position(); }
  bool overran() const { return reader_.overran(); }

 private:
  static std::vector<uint8_t> copied(BitReader& from, uint64_t most) {
    std::vector<uint8_t> bytes;
    for (; bytes.size() < (most + 7) / 8; bytes.push_back(static_cast<uint8_t>(from.get(8))))
      if (from.overran()) break;
    return bytes;
  }
  const std::vector<uint8_t> bytes_;
  BitReader reader_;
};

}  // namespace tilepress::python
