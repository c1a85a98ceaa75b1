// Cut snappy block: recovers the beginning of a snappy block whose end is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tilepress {

/// Unpacks the elements of a raw snappy block, which begin after its length. Stops at an element that is not
/// whole, does not fit into `plain`, or refers to bytes before it. Returns the bytes unpacked. libsnappy's
/// own function for this writes past the end of its buffer if the block is also damaged.
size_t unpack_cut_block(std::span<const uint8_t> packed, std::span<uint8_t> plain);

}  // namespace tilepress
