// RAS stream: planes, residuals, writing and reading. The kernels predict and choose k (ras_kernels.cpp).
#include "ras/ras_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <numeric>

#include "ras/ras_kernels.h"

namespace tilepress {
namespace {

uint32_t group_begin(uint32_t group) {
  return group == 0 ? 1 : 0;
}

/// The planes of a format in the stream.
struct PlaneWidths {
  uint32_t count = 0;
  std::array<uint8_t, 4> first_bits{};  ///< bits of the plane's first pixel
  std::array<bool, 4> is_signed{};      ///< Co and Cg: stored as two's complement
};

PlaneWidths plane_widths(const FormatTraits& format, bool ycocg) {
  PlaneWidths planes{.count = format.channel_bits[3] != 0 ? 4u : 3u, .first_bits = format.channel_bits};
  if (!ycocg) return planes;
  const uint8_t widest = std::max({format.channel_bits[0], format.channel_bits[1], format.channel_bits[2]});
  planes.first_bits[0] = widest;
  planes.first_bits[1] = planes.first_bits[2] = static_cast<uint8_t>(widest + 1);
  planes.is_signed[1] = planes.is_signed[2] = true;
  return planes;
}

/// True if the bytes of a pixel are its samples.
bool samples_are_bytes(const FormatTraits& format, bool ycocg) {
  return !ycocg && format.channel_bits[0] == 8;  // then all four are
}

/// Returns the four plane values of a pixel; 0 for an absent plane.
void split_pixel(uint32_t word, const FormatTraits& format, bool ycocg, int32_t* value) {
  for (int c = 0; c < 4; ++c) value[c] = static_cast<int32_t>(channel(format, word, c));
  if (!ycocg) return;
  const int32_t r = value[0], g = value[1], b = value[2];
  const int32_t co = r - b, t = b + (co >> 1), cg = g - t;
  value[0] = t + (cg >> 1);
  value[1] = co;
  value[2] = cg;
}

/// Returns the pixel of four plane values. Sets bits of `stray` if a channel is out of its range, so that no
/// pixel was split into these values.
uint32_t join_pixel(const int16_t* sample, const FormatTraits& format, bool ycocg, uint32_t& stray) {
  int32_t value[4];
  std::copy_n(sample, 4, value);
  if (ycocg) {
    const int32_t y = value[0], co = value[1], cg = value[2];
    const int32_t t = y - (cg >> 1), g = cg + t, b = t - (co >> 1);
    value[0] = b + co;
    value[1] = g;
    value[2] = b;
  }
  uint32_t word = 0;
  for (int c = 0; c < 4; ++c) {
    stray |= static_cast<uint32_t>(value[c]) >> format.channel_bits[c];
    word |= static_cast<uint32_t>(value[c]) << format.channel_shift[c];
  }
  return word;
}

void load_samples(const uint32_t* top_left, uint32_t stride, const FormatTraits& format, bool ycocg,
                  int16_t* samples) {
  if (samples_are_bytes(format, ycocg)) {
    ras_kernels().widen_bytes(top_left, stride, samples);
  } else {
    for (uint32_t y = 0; y < kBlockSide; ++y)
      for (uint32_t x = 0; x < kBlockSide; ++x) {
        int32_t value[4];
        split_pixel(top_left[size_t{y} * stride + x], format, ycocg, value);
        int16_t* at = samples + ras_sample_index(static_cast<int32_t>(x), static_cast<int32_t>(y));
        for (int c = 0; c < 4; ++c) at[c] = static_cast<int16_t>(value[c]);
      }
  }
  fill_ras_border(samples);
}

/// See ras_bits_beside_groups.
int32_t bits_beside_groups(const PlaneWidths& planes) {
  int32_t bits = 0;
  for (uint32_t p = 0; p < 4; ++p)
    bits += p < planes.count ? planes.first_bits[p] : -static_cast<int32_t>(kRasZeroPlaneBits);
  return bits;
}

/// A BitWriter without branches. It begins at a byte and may write up to eight bytes past its bits.
class RoomyWriter {
 public:
  static constexpr uint32_t kMostBits = 56;  ///< beside up to 7 of the byte begun
  explicit RoomyWriter(uint8_t* at) : at_(at) {}
  /// 1 ≤ count ≤ kMostBits.
  void put(uint64_t value, uint32_t count) {
    pending_ += count;
    accumulator_ |= value << (64 - pending_);
    const uint64_t bytes = bit_io::big_endian(accumulator_);
    std::memcpy(at_, &bytes, sizeof bytes);
    at_ += pending_ / 8;
    accumulator_ <<= pending_ & ~7u;
    pending_ %= 8;
  }

 private:
  uint8_t* at_;
  uint64_t accumulator_ = 0;  ///< bits of the byte begun, from the top
  uint32_t pending_ = 0;      ///< their number
};

template <typename Writer>
void write_planes(const int16_t* first, const RasGroups& groups, const PlaneWidths& planes, Writer& out) {
  for (uint32_t p = 0; p < planes.count; ++p)
    out.put(static_cast<uint32_t>(first[p]) & ((1u << planes.first_bits[p]) - 1), planes.first_bits[p]);
  for (uint32_t p = 0; p < planes.count; ++p)
    for (uint32_t group = 0; group < kSubBlocks; ++group) {
      const uint32_t at = ras_group_index(p, group);
      const auto length = static_cast<uint32_t>(groups.lengths[at]);
      if (length <= RoomyWriter::kMostBits) {
        out.put(groups.codes[at], length);
        continue;
      }
      const uint32_t k = groups.k[at];
      out.put(k, 3);
      for (uint32_t i = group_begin(group); i < 4; ++i) {
        const uint32_t value = groups.residuals[i][at];
        for (uint32_t ones = value >> k; ones > 0; --ones) out.put(1, 1);
        out.put(value & ((1u << k) - 1), k + 1);
      }
    }
}

}  // namespace

int32_t ras_bits_beside_groups(const FormatTraits& format, bool ycocg) {
  return bits_beside_groups(plane_widths(format, ycocg));
}

uint32_t ras_group_bits(const uint32_t* top_left, uint32_t stride, const FormatTraits& format, bool ycocg) {
  int16_t samples[kRasSamples];
  load_samples(top_left, stride, format, ycocg, samples);
  return ras_kernels().code_bits(samples);
}

void ras_stream_write(const Block& block, const FormatTraits& format, bool ycocg, BitWriter& out) {
  int16_t samples[kRasSamples];
  load_samples(block.pixels.data(), kBlockSide, format, ycocg, samples);
  RasGroups groups;
  ras_kernels().groups(samples, groups);
  const PlaneWidths planes = plane_widths(format, ycocg);
  const int16_t* first = samples + ras_sample_index(0, 0);
  const auto bits = static_cast<uint32_t>(
      std::accumulate(groups.lengths, std::end(groups.lengths), bits_beside_groups(planes)));
  if (uint8_t* to = out.at_byte(bits / 8 + 9)) {
    RoomyWriter writer(to);
    write_planes(first, groups, planes, writer);
    out.wrote(bits);
  } else {
    write_planes(first, groups, planes, out);
  }
}

namespace {

/// Reads the groups of a plane and stores the residuals that are not zero. Returns false if a residual is not
/// below twice `largest`, a power of two. (A residual between `largest` and that makes a sample out of its
/// range.)
bool read_residuals(BitReader& stream, uint32_t largest, int16_t* residuals) {
  BitReader in = stream;  // the compiler keeps a copy in registers
  uint32_t any = 0;
  for (uint32_t group = 0; group < kSubBlocks;) {
    uint64_t window = in.peek();
    const auto k = static_cast<uint32_t>(window >> 61);
    if (k == kRasZeroGroup) {  // often several in a row
      const uint32_t count = std::min(static_cast<uint32_t>(std::countl_one(window)) / 3, kSubBlocks - group);
      in.skip(3 * count);
      group += count;
      continue;
    }
    window <<= 3;
    int16_t* const to = residuals + 4 * kTraversal[4 * group];
    uint32_t i = group_begin(group), used = 3;
    const auto take = [&](uint32_t high, uint32_t low) {
      const uint32_t u = high << k | low;
      any |= u;
      to[4 * (i / 2 * kBlockSide + i % 2)] = static_cast<int16_t>(u >> 1 ^ (0 - (u & 1)));
    };
    for (; i < 4; ++i) {
      const auto ones = static_cast<uint32_t>(std::countl_one(window));
      if (used + ones + 1 + k > kMaxBitsPerCall) break;
      used += ones + 1 + k;
      window = window << ones << 1;
      take(ones, static_cast<uint32_t>(window >> 1 >> (63 - k)));
      window <<= k;
    }
    in.skip(used);
    for (; i < 4; ++i) {  // residuals beyond the window
      const uint32_t high = in.get_unary(largest >> k);
      take(high, static_cast<uint32_t>(in.get(k)));
    }
    ++group;
  }
  stream = in;
  return any < 2 * largest;
}

/// Returns false if a sample or a channel is out of its range, so that no block has these samples.
bool join_samples(const int16_t* samples, const FormatTraits& format, bool ycocg, Block& out) {
  if (samples_are_bytes(format, ycocg)) return ras_kernels().narrow_bytes(samples, out.pixels.data());
  uint32_t stray = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    for (uint32_t p = 0; p < 4; ++p)
      stray |= static_cast<uint32_t>(samples[4 * i + p] + kRasMostSample) & ~(2u * kRasMostSample - 1);
    out.pixels[i] = join_pixel(samples + 4 * i, format, ycocg, stray);
  }
  return stray == 0;
}

}  // namespace

bool ras_stream_read(BitReader& in, const FormatTraits& format, bool ycocg, Block& out) {
  const PlaneWidths planes = plane_widths(format, ycocg);
  int16_t samples[4 * kBlockPixels] = {};
  for (uint32_t p = 0; p < planes.count; ++p) {
    const uint32_t bits = planes.first_bits[p];
    const auto raw = static_cast<int32_t>(in.get(bits));
    samples[p] =
        static_cast<int16_t>(planes.is_signed[p] && raw >= 1 << (bits - 1) ? raw - (1 << bits) : raw);
  }
  for (uint32_t p = 0; p < planes.count; ++p)
    if (!read_residuals(in, 2u << planes.first_bits[p], samples + p)) return false;
  if (in.overran()) return false;
  ras_kernels().restore(samples);
  return join_samples(samples, format, ycocg, out);
}

}  // namespace tilepress
