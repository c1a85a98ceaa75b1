// Cut snappy block: what can be saved of a snappy block whose end is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tilepress {

/// Unpacks the elements of a raw snappy block (behind its length) until one is not whole, does not fit into
/// `plain`, or points in front of it. Returns the bytes unpacked. libsnappy has a function for this, which
/// writes past the end of its buffer when the block is damaged as well.
size_t unpack_cut_block(std::span<const uint8_t> packed, std::span<uint8_t> plain);

}  // namespace tilepress
