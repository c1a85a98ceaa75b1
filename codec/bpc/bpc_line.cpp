// BPC line: bit planes of the deltas, and their codes.
#include "bpc/bpc_line.h"

#include <bit>

namespace tilepress {
namespace {

constexpr uint32_t kPlanes = 33;
constexpr uint32_t kAllOnes = 0x7FFFFFFF;  ///< 31 deltas
using Planes = std::array<uint32_t, kPlanes>;

/// Swaps rows and columns of 32×32 bits: bit c of rows[r] is bit r of rows[c] before. Each step swaps two
/// quarters of squares half as large as the step before.
void transpose(uint32_t* rows) {
  uint32_t low = 0x0000FFFF;
  for (uint32_t side = 16; side != 0; side /= 2, low ^= low << side)
    for (uint32_t row = 0; row < 32; row = (row + side + 1) & ~side) {
      const uint32_t swapped = (rows[row] >> side ^ rows[row + side]) & low;
      rows[row] ^= swapped << side;
      rows[row + side] ^= swapped;
    }
}

Planes planes_of(const uint32_t* words) {
  Planes planes{};
  uint32_t signs = 0;
  for (uint32_t i = 0; i + 1 < kBpcWords; ++i) {
    planes[i] = words[i + 1] - words[i];
    signs |= uint32_t{words[i + 1] < words[i]} << i;
  }
  transpose(planes.data());
  planes[kPlanes - 1] = signs;  // bit 32 of the deltas
  return planes;
}

bool extends(uint32_t word, uint32_t bits) {
  const auto value = static_cast<int32_t>(word);
  const int32_t half = 1 << (bits - 1);
  return value >= -half && value < half;
}

/// Calls put(value, bits) for each code of the line.
template <typename Put>
void for_each_code(const uint32_t* words, Put&& put) {
  const uint32_t base = words[0];
  if (base == 0)
    put(0, 3);
  else if (extends(base, 4))
    put(1u << 4 | (base & 0xF), 7);
  else if (extends(base, 8))
    put(2u << 8 | (base & 0xFF), 11);
  else if (extends(base, 16))
    put(3u << 16 | (base & 0xFFFF), 19);
  else
    put(uint64_t{1} << 32 | base, 33);

  const Planes planes = planes_of(words);
  uint32_t zeros = 0, above = 0;
  const auto end_run = [&] {
    if (zeros == 1) put(1, 3);
    if (zeros >= 2) put(1u << 5 | (zeros - 2), 7);
    zeros = 0;
  };
  for (uint32_t b = kPlanes; b-- > 0;) {
    const uint32_t plane = planes[b], change = plane ^ above;
    above = plane;
    if (change == 0) {
      ++zeros;
      continue;
    }
    end_run();
    const auto lowest = static_cast<uint32_t>(std::countr_zero(change));
    if (change == kAllOnes)
      put(0, 5);
    else if (plane == 0)
      put(1, 5);
    else if (change == 1u << lowest)
      put(3u << 5 | lowest, 10);
    else if (change == 3u << lowest)
      put(2u << 5 | lowest, 10);
    else
      put(uint64_t{1} << 31 | change, 32);
  }
  end_run();
}

uint32_t sign_extended(uint64_t value, uint32_t bits) {
  const uint32_t sign = 1u << (bits - 1);
  return (static_cast<uint32_t>(value) ^ sign) - sign;
}

uint32_t read_base(BitReader& in) {
  if (in.get(1) != 0) return static_cast<uint32_t>(in.get(32));
  constexpr uint32_t kWidths[] = {0, 4, 8, 16};
  const uint32_t bits = kWidths[in.get(2)];
  return bits == 0 ? 0 : sign_extended(in.get(bits), bits);
}

/// Reads the change of a plane outside runs of zeros. `in` is behind the 000 of its code.
bool read_rare_change(BitReader& in, uint32_t above, uint32_t& change) {
  const auto kind = static_cast<uint32_t>(in.get(2));
  if (kind == 0) return change = kAllOnes, true;
  if (kind == 1) return change = above, above != 0;  // the plane itself is zero
  const auto lowest = static_cast<uint32_t>(in.get(5));
  change = (kind == 2 ? 3u : 1u) << lowest;
  return lowest + (kind == 2) < kBpcWords - 1;
}

}  // namespace

uint32_t bpc_line_bits(const uint32_t* words) {
  uint32_t total = 0;
  for_each_code(words, [&](uint64_t, uint32_t bits) { total += bits; });
  return total;
}

void bpc_line_write(const uint32_t* words, BitWriter& out) {
  for_each_code(words, [&](uint64_t value, uint32_t bits) { out.put(value, bits); });
}

bool bpc_line_read(BitReader& in, uint32_t* words) {
  words[0] = read_base(in);
  Planes planes{};
  uint32_t above = 0;
  for (uint32_t left = kPlanes; left > 0;) {
    uint32_t change = 0, count = 1;
    if (in.get(1) != 0)
      change = static_cast<uint32_t>(in.get(31));
    else if (in.get(1) != 0)
      count = static_cast<uint32_t>(in.get(5)) + 2;
    else if (in.get(1) == 0 && !read_rare_change(in, above, change))
      return false;
    if (count > left) return false;
    above ^= change;
    for (; count > 0; --count) planes[--left] = above;
  }
  for (uint32_t i = 0; i + 1 < kBpcWords; ++i) {
    uint64_t delta = 0;
    for (uint32_t b = 0; b < kPlanes; ++b) delta |= uint64_t{planes[b] >> i & 1} << b;
    // A delta that leaves 32 bits has another sign than the difference that it codes.
    const uint64_t next = words[i] + delta;
    if ((next >> 32 & 1) != 0) return false;
    words[i + 1] = static_cast<uint32_t>(next);
  }
  return !in.overran();
}

}  // namespace tilepress
