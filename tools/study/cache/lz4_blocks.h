// LZ4 blocks: bytes in independent blocks, so that a decoded block is still in the processor's cache when it
// is taken apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace tilepress {

constexpr size_t kLz4BlockBytes = size_t{1} << 17;  ///< decoded; the last block of a frame may have fewer

/// Sets `out` to the blocks of `bytes`: each is its size in 4 bytes, little-endian, and an LZ4 block.
void pack_lz4_blocks(std::span<const std::byte> bytes, std::string& out);

/// Reads blocks one after the other.
class Lz4Blocks {
 public:
  explicit Lz4Blocks(std::span<const std::byte> stored) : left_(stored) {}
  /// Decodes the next block, which must fill `out`. Returns false if it does not.
  bool next(std::span<std::byte> out);
  bool at_end() const { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
};

}  // namespace tilepress
