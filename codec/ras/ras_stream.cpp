// RAS stream: planes, residuals, the choice of k, writing and reading.
#include "ras/ras_stream.h"

#include <algorithm>

#include "ras/ras_samples.h"
#include "simd/kernels.h"

namespace tilepress {
namespace {

using Plane = std::array<int32_t, kBlockPixels>;
using Residuals = std::array<uint32_t, kBlockPixels>;

/// Prediction of pixel (x, y) from the pixels before it; not for (0, 0).
int32_t predict(const Plane& plane, uint32_t x, uint32_t y) {
  const int32_t* at = &plane[8 * y + x];
  if (y == 0) return at[-1];
  if (x == 0) return at[-8];
  const int32_t a = at[-1], b = at[-8], c = at[-9];
  if (c >= std::max(a, b)) return std::min(a, b);
  if (c <= std::min(a, b)) return std::max(a, b);
  return a + b - c;
}

uint32_t fold(int32_t e) {
  return e >= 0 ? 2u * static_cast<uint32_t>(e) : 2u * static_cast<uint32_t>(-e) - 1;
}
int32_t unfold(uint32_t u) {
  return (u & 1) != 0 ? -static_cast<int32_t>(u / 2) - 1 : static_cast<int32_t>(u / 2);
}

/// Folded residuals by raster position; position 0 holds 0.
void residuals_of(const Plane& plane, Residuals& u) {
  u[0] = 0;
  for (uint32_t y = 0; y < kBlockSide; ++y)
    for (uint32_t x = y == 0 ? 1 : 0; x < kBlockSide; ++x)
      u[8 * y + x] = fold(plane[8 * y + x] - predict(plane, x, y));
}

struct GroupCode {
  uint32_t k;
  uint32_t bits;  ///< with the 3 bits of k
};

uint32_t group_begin(uint32_t group) {
  return group == 0 ? 1 : 0;
}

GroupCode choose_code(const Residuals& u, uint32_t group) {
  uint32_t values[4], any = 0;
  const uint32_t begin = group_begin(group);
  for (uint32_t i = begin; i < 4; ++i) any |= values[i] = u[kTraversal[4 * group + i]];
  if (any == 0) return {kRasZeroGroup, 3};
  GroupCode best{0, ~0u};
  for (uint32_t k = 0; k <= kRasLargestK; ++k) {
    uint32_t bits = 3;
    for (uint32_t i = begin; i < 4; ++i) bits += (values[i] >> k) + 1 + k;
    if (bits < best.bits) best = {k, bits};
  }
  return best;
}

/// False: a channel is out of its range, so no block was encoded to these planes.
bool join_planes(const RasPlanes& planes, const FormatTraits& format, bool ycocg, Block& out) {
  uint32_t stray = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    int32_t value[4] = {};
    for (uint32_t p = 0; p < planes.count; ++p) value[p] = planes.samples[p][i];
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
    out.pixels[i] = word;
  }
  return stray == 0;
}

/// The four plane values of a pixel; 0 for an absent plane.
void split_pixel(uint32_t word, const FormatTraits& format, bool ycocg, int32_t* value) {
  for (int c = 0; c < 4; ++c) value[c] = static_cast<int32_t>(channel(format, word, c));
  if (!ycocg) return;
  const int32_t r = value[0], g = value[1], b = value[2];
  const int32_t co = r - b, t = b + (co >> 1), cg = g - t;
  value[0] = t + (cg >> 1);
  value[1] = co;
  value[2] = cg;
}

uint32_t plane_count(const FormatTraits& format) {
  return format.channel_bits[3] != 0 ? 4 : 3;
}

void plane_widths(const FormatTraits& format, bool ycocg, RasPlanes& planes) {
  planes.count = plane_count(format);
  planes.is_signed.fill(false);
  planes.first_bits = format.channel_bits;
  if (!ycocg) return;
  const uint8_t widest = std::max({format.channel_bits[0], format.channel_bits[1], format.channel_bits[2]});
  planes.first_bits[0] = widest;
  planes.first_bits[1] = planes.first_bits[2] = static_cast<uint8_t>(widest + 1);
  planes.is_signed[1] = planes.is_signed[2] = true;
}

}  // namespace

void split_planes(const Block& block, const FormatTraits& format, bool ycocg, RasPlanes& planes) {
  plane_widths(format, ycocg, planes);
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    int32_t value[4];
    split_pixel(block.pixels[i], format, ycocg, value);
    for (uint32_t p = 0; p < planes.count; ++p) planes.samples[p][i] = value[p];
  }
}

uint32_t ras_stream_bits(const uint32_t* top_left, uint32_t stride, const FormatTraits& format, bool ycocg) {
  int16_t samples[kRasSamples];
  RasPlanes planes;
  plane_widths(format, ycocg, planes);
  const bool four_bytes = format.channel_bits[0] == 8;  // then all four are
  if (four_bytes && !ycocg) {
    kernels().widen_bytes(top_left, stride, samples);
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
  uint32_t bits = kernels().ras_code_bits(samples);
  for (uint32_t p = 0; p < planes.count; ++p) bits += planes.first_bits[p];
  return bits - (4 - planes.count) * kSubBlocks * 3;  // an absent plane is all zeros, 3 bits a group
}

uint32_t ras_uniform_bits(const FormatTraits& format, bool ycocg) {
  RasPlanes planes;
  plane_widths(format, ycocg, planes);
  uint32_t bits = planes.count * kSubBlocks * 3;
  for (uint32_t p = 0; p < planes.count; ++p) bits += planes.first_bits[p];
  return bits;
}

void ras_stream_write(const Block& block, const FormatTraits& format, bool ycocg, BitWriter& out) {
  RasPlanes planes;
  split_planes(block, format, ycocg, planes);
  for (uint32_t p = 0; p < planes.count; ++p)
    out.put(static_cast<uint32_t>(planes.samples[p][0]) & ((1u << planes.first_bits[p]) - 1),
            planes.first_bits[p]);
  Residuals u;
  for (uint32_t p = 0; p < planes.count; ++p) {
    residuals_of(planes.samples[p], u);
    for (uint32_t group = 0; group < kSubBlocks; ++group) {
      const uint32_t k = choose_code(u, group).k;
      out.put(k, 3);
      if (k == kRasZeroGroup) continue;
      for (uint32_t i = group_begin(group); i < 4; ++i) {
        const uint32_t value = u[kTraversal[4 * group + i]];
        out.put_unary(value >> k);
        out.put(value & ((1u << k) - 1), k);
      }
    }
  }
}

bool ras_stream_read(BitReader& in, const FormatTraits& format, bool ycocg, Block& out) {
  RasPlanes planes;
  plane_widths(format, ycocg, planes);
  for (uint32_t p = 0; p < planes.count; ++p) {
    const uint32_t bits = planes.first_bits[p];
    const auto raw = static_cast<int32_t>(in.get(bits));
    planes.samples[p][0] = planes.is_signed[p] && raw >= 1 << (bits - 1) ? raw - (1 << bits) : raw;
  }
  for (uint32_t p = 0; p < planes.count; ++p) {
    Residuals u{};
    const uint32_t largest = 2u << planes.first_bits[p];
    for (uint32_t group = 0; group < kSubBlocks; ++group) {
      const auto k = static_cast<uint32_t>(in.get(3));
      if (k == kRasZeroGroup) continue;
      for (uint32_t i = group_begin(group); i < 4; ++i) {
        const uint32_t high = in.get_unary(largest >> k);
        if (high > largest >> k) return false;
        u[kTraversal[4 * group + i]] = high << k | static_cast<uint32_t>(in.get(k));
      }
    }
    Plane& plane = planes.samples[p];
    for (uint32_t i = 1; i < kBlockPixels; ++i) {
      plane[i] = predict(plane, i % 8, i / 8) + unfold(u[i]);
      // Predictions stay between their neighbours, so 64 residuals of a bounded size cannot overflow.
    }
  }
  if (in.overran()) return false;
  return join_planes(planes, format, ycocg, out);
}

}  // namespace tilepress
