// CRC-64/XZ: four bytes at a time.
#include "te/crc64.h"

#include <array>

namespace tilepress {
namespace {

constexpr uint64_t kPolynomial = 0xC96C5795D7870F42u;  // 0x42F0E1EBA9EA3693 reflected

using Table = std::array<std::array<uint64_t, 256>, 4>;

constexpr Table make_table() {
  Table table{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint64_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ kPolynomial : crc >> 1;
    table[0][byte] = crc;
  }
  for (uint32_t byte = 0; byte < 256; ++byte)
    for (uint32_t i = 1; i < 4; ++i)
      table[i][byte] = table[0][table[i - 1][byte] & 0xFF] ^ table[i - 1][byte] >> 8;
  return table;
}
constexpr Table kTable = make_table();

}  // namespace

uint64_t crc64(std::span<const uint32_t> words, uint32_t word_bytes, uint64_t crc) {
  crc = ~crc;
  for (const uint32_t word : words) {
    if (word_bytes == 4) {
      const uint32_t low = static_cast<uint32_t>(crc) ^ word;
      crc = crc >> 32 ^ kTable[3][low & 0xFF] ^ kTable[2][low >> 8 & 0xFF] ^ kTable[1][low >> 16 & 0xFF] ^
            kTable[0][low >> 24];
      continue;
    }
    for (uint32_t byte = 0; byte < word_bytes; ++byte)
      crc = kTable[0][(crc ^ word >> 8 * byte) & 0xFF] ^ crc >> 8;
  }
  return ~crc;
}

}  // namespace tilepress
