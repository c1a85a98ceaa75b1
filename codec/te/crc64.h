// CRC-64/XZ (ECMA-182, reflected): the checksum of transaction elimination.
#pragma once

#include <cstdint>
#include <span>

namespace tilepress {

/// Returns the checksum of the low `word_bytes` (2 or 4) bytes of each word, little-endian. `crc` is the
/// checksum of the words before, or 0.
uint64_t crc64(std::span<const uint32_t> words, uint32_t word_bytes, uint64_t crc);

}  // namespace tilepress
