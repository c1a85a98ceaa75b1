// Reference model: base-delta-immediate and bit-plane compression of a block's memory lines.
#include <algorithm>
#include <string>

#include "reference_model.h"

namespace reference {
namespace {

/// The block's bytes as they lie in memory.
std::vector<uint8_t> bytes_of(const std::vector<uint32_t>& block, PixelFormat format, bool quads) {
  std::vector<uint8_t> bytes;
  for (uint32_t i = 0; i < 64; ++i) {
    uint32_t position = i;
    if (quads) position = (i / 16 * 2 + i % 4 / 2) * 8 + i / 4 % 4 * 2 + i % 2;
    for (uint32_t byte = 0; byte < (format == PixelFormat::kRgb565 ? 2u : 4u); ++byte)
      bytes.push_back(static_cast<uint8_t>(block[position] >> 8 * byte));
  }
  return bytes;
}

uint64_t little_endian(const std::vector<uint8_t>& bytes, size_t at, uint32_t count) {
  uint64_t value = 0;
  for (uint32_t i = 0; i < count; ++i) value += uint64_t{bytes[at + i]} << 8 * i;
  return value;
}

/// Is the low `size`-byte number, read as signed, within `delta` signed bytes?
bool small(uint64_t value, uint32_t size, uint32_t delta) {
  const auto number = static_cast<int64_t>(value << (64 - 8 * size)) >> (64 - 8 * size);
  const int64_t half = int64_t{1} << (8 * delta - 1);
  return number >= -half && number < half;
}

bool base_delta_fits(const std::vector<uint8_t>& line, uint32_t size, uint32_t delta) {
  bool has_base = false;
  uint64_t base = 0;
  for (size_t at = 0; at < 64; at += size) {
    const uint64_t value = little_endian(line, at, size);
    if (small(value, size, delta)) continue;
    if (!has_base) base = value;
    has_base = true;
    if (!small(value - base, size, delta)) return false;
  }
  return true;
}

uint32_t bdi_line_bits(const std::vector<uint8_t>& line) {
  bool repeated = true;
  for (size_t at = 8; at < 64; ++at) repeated &= line[at] == line[at - 8];
  if (repeated) return little_endian(line, 0, 8) == 0 ? 0 : 64;
  uint32_t best = 512;
  const uint32_t forms[][2] = {{8, 1}, {8, 2}, {8, 4}, {4, 1}, {4, 2}, {2, 1}};
  for (const auto& [size, delta] : forms)
    if (base_delta_fits(line, size, delta)) best = std::min(best, 8 * size + 64 / size * (1 + 8 * delta));
  return best;
}

uint32_t bpc_line_bits(const std::vector<uint8_t>& line) {
  std::vector<int64_t> words;
  for (size_t at = 0; at < 128; at += 4) words.push_back(static_cast<int64_t>(little_endian(line, at, 4)));
  uint32_t bits = 33;
  if (small(static_cast<uint64_t>(words[0]), 4, 2)) bits = 19;
  if (small(static_cast<uint64_t>(words[0]), 4, 1)) bits = 11;
  const int32_t base = static_cast<int32_t>(static_cast<uint32_t>(words[0]));
  if (base >= -8 && base < 8) bits = 7;
  if (base == 0) bits = 3;
  std::string above(31, '0');
  uint32_t zeros = 0;
  const auto end_run = [&] {
    if (zeros > 0) bits += zeros == 1 ? 3 : 7;
    zeros = 0;
  };
  for (int plane = 32; plane >= 0; --plane) {
    std::string now(31, '0'), change(31, '0');
    for (size_t i = 0; i < 31; ++i) {
      now[i] = ((words[i + 1] - words[i]) >> plane & 1) != 0 ? '1' : '0';
      change[i] = now[i] != above[i] ? '1' : '0';
    }
    above = now;
    const auto ones = std::count(change.begin(), change.end(), '1');
    if (ones == 0) {
      ++zeros;
      continue;
    }
    end_run();
    if (ones == 31 || now.find('1') == std::string::npos)
      bits += 5;
    else if (ones == 1 || (ones == 2 && change.find("11") != std::string::npos))
      bits += 10;
    else
      bits += 32;
  }
  end_run();
  const uint32_t bytes = (bits + 7) / 8;
  return bytes > 127 ? 1024 : 8 * bytes;
}

}  // namespace

uint32_t bdi_bits(const std::vector<uint32_t>& block, PixelFormat format, bool quads) {
  const std::vector<uint8_t> bytes = bytes_of(block, format, quads);
  uint32_t bits = 0;
  for (size_t at = 0; at < bytes.size(); at += 64)
    bits += bdi_line_bits(
        {bytes.begin() + static_cast<ptrdiff_t>(at), bytes.begin() + static_cast<ptrdiff_t>(at) + 64});
  return bits;
}

uint32_t bpc_bits(const std::vector<uint32_t>& block, PixelFormat format, bool quads) {
  const std::vector<uint8_t> bytes = bytes_of(block, format, quads);
  uint32_t bits = 0;
  for (size_t at = 0; at < bytes.size(); at += 128)
    bits += bpc_line_bits(
        {bytes.begin() + static_cast<ptrdiff_t>(at), bytes.begin() + static_cast<ptrdiff_t>(at) + 128});
  return bits;
}

}  // namespace reference
