// LZ4 blocks: bytes in independent blocks, so that a decoded block is still in the processor's cache when it
// is taken apart.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tilepress {

constexpr size_t kLz4BlockBytes = size_t{1} << 17;  ///< decoded; the last block of a frame may have fewer

/// Sets `out` to the blocks of `bytes`. Each is a word of 4 bytes, little-endian, and its bytes: the word is
/// their count, with bit 31 set if they are stored as they are. Blocks that LZ4 hardly makes smaller take
/// long to decode. They are stored, the worst ones first, as long as all blocks together have at most
/// `budget` bytes.
void pack_lz4_blocks(std::span<const std::byte> bytes, size_t budget, std::string& out);

/// Reads blocks one after the other.
class Lz4Blocks {
 public:
  explicit Lz4Blocks(std::span<const std::byte> stored) : left_(stored) {}
  /// Returns the next block, which has the size of `room`, in `room` or among the stored bytes. Returns
  /// nothing if the block is damaged. Precondition: `room` is not empty.
  std::span<const std::byte> next(std::span<std::byte> room);
  bool at_end() const { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
};

}  // namespace tilepress
