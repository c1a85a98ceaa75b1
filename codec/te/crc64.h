// CRC-64/XZ (ECMA-182, reflected): the checksum of transaction elimination.
#pragma once

#include <cstdint>
#include <span>

namespace tilepress {

/// Of the words' little-endian bytes; `word_bytes` (2 or 4) of each. Continues `crc`, which begins at 0.
uint64_t crc64(std::span<const uint32_t> words, uint32_t word_bytes, uint64_t crc);

}  // namespace tilepress
