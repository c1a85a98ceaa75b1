// DCC line: the smallest form of each channel, and its bits.
#include "amd/dcc_line.h"

#include <algorithm>
#include <bit>

namespace tilepress {
namespace {

constexpr uint32_t kChannels = 4;
constexpr uint32_t kHalves = 2;
constexpr uint32_t kHalfPixels = 8;
constexpr uint32_t kLastUpper = 5;  ///< u3
constexpr uint32_t kFlagBytes = 2;  ///< of a line
constexpr uint32_t kMostPlanes = 7;
constexpr uint32_t kLanes = kChannels * kDccLines;
/// The pixel that pixel i is a difference from, i = 1 … 7.
constexpr uint8_t kBefore[kHalfPixels] = {0, 0, 0, 2, 1, 4, 4, 6};

constexpr uint32_t to_channels(uint32_t pixel) {
  const uint32_t g = pixel >> 8 & 0xFF;
  const uint32_t cr = (pixel - g) & 0xFF, cb = ((pixel >> 16) - g) & 0xFF;
  return g | cr << 8 | cb << 16 | (pixel & 0xFF000000);
}
constexpr uint32_t from_channels(uint32_t channels) {
  const uint32_t g = channels & 0xFF;
  const uint32_t r = ((channels >> 8) + g) & 0xFF, b = ((channels >> 16) + g) & 0xFF;
  return r | g << 8 | b << 16 | (channels & 0xFF000000);
}

constexpr uint8_t sign_of(uint8_t difference) {
  return difference >> 7;
}
constexpr uint8_t magnitude_of(uint8_t difference) {
  return static_cast<uint8_t>(difference ^ (sign_of(difference) ? 0xFF : 0));
}
constexpr uint8_t planes_for(uint8_t magnitudes) {
  return static_cast<uint8_t>(std::bit_width(magnitudes));
}

/// What is known of one channel of a line.
struct ChannelShape {
  bool left_constant, right_constant;
  bool left_zero;                     ///< u0 of the left half is 0
  bool right_continues;               ///< u0 of the right half equals u3 of the left half
  uint8_t left_planes, right_planes;  ///< for the differences within the half
  uint8_t joint_planes;               ///< for those of both halves and between them
};

/// Returns the smallest form. Flag combinations (left byte, right byte, left constant, right constant) 0000,
/// 0010, 0100, 0110, 0111 and 1010 are never chosen.
DccForm smallest_form(const ChannelShape& shape) {
  DccForm form;
  form.left_constant = shape.left_constant;
  form.right_constant = shape.right_constant;
  form.left_planes = shape.left_planes;
  form.right_planes = shape.right_planes;
  if (shape.left_constant) {
    form.right_byte = !shape.right_constant || !shape.right_continues;
    form.left_byte = form.right_byte || !shape.left_zero;
    return form;
  }
  if (shape.right_constant) {
    form.left_byte = shape.left_planes < kMostPlanes;  // without it there are 7 planes, and a byte less
    form.right_byte = !shape.right_continues;
    return form;
  }
  form.left_byte = 1;
  form.right_byte = 2u * shape.joint_planes > 1u + shape.left_planes + shape.right_planes;
  if (!form.right_byte) form.left_planes = form.right_planes = shape.joint_planes;
  return form;
}

/// Returns false for the combinations that smallest_form() never chooses.
bool observed(const DccForm& form) {
  constexpr uint32_t kNever =
      1u << 0b0000 | 1u << 0b0010 | 1u << 0b0100 | 1u << 0b0110 | 1u << 0b0111 | 1u << 0b1010;
  const uint32_t flags =
      form.left_byte << 3 | form.right_byte << 2 | form.left_constant << 1 | form.right_constant;
  return (kNever >> flags & 1) == 0;
}

/// Appends the signs and planes of a half. `before`: what u0 is a difference from, if it has no base.
void write_half(const uint8_t (&values)[kHalfPixels], bool has_byte, uint8_t before, uint32_t planes,
                LowFirstBits& out) {
  uint8_t magnitudes[kHalfPixels];
  uint32_t signs = 0;
  for (uint32_t i = 0; i < kHalfPixels; ++i) {
    const auto difference = static_cast<uint8_t>(values[i] - (i == 0 ? before : values[kBefore[i]]));
    magnitudes[i] = magnitude_of(difference);
    signs |= uint32_t{sign_of(difference)} << i;
  }
  if (has_byte) {
    magnitudes[0] = values[0] >> 1;
    signs = (signs & ~1u) | (values[0] & 1);
  }
  out.put(signs, 8);
  for (uint32_t plane = 0; plane < planes; ++plane) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kHalfPixels; ++i) bits |= (magnitudes[i] >> plane & 1u) << i;
    out.put(bits, 8);
  }
}

/// Reads what write_half() writes. `base`: the bits of u0 above the planes, if it has a base.
void read_half(LowFirstBits& in, bool has_byte, uint8_t base, uint8_t before, uint32_t planes,
               uint8_t (&values)[kHalfPixels]) {
  uint32_t magnitudes[kHalfPixels] = {};
  const uint32_t signs = in.get(8);
  for (uint32_t plane = 0; plane < planes; ++plane) {
    const uint32_t bits = in.get(8);
    for (uint32_t i = 0; i < kHalfPixels; ++i) magnitudes[i] |= (bits >> i & 1) << plane;
  }
  for (uint32_t i = 0; i < kHalfPixels; ++i) {
    const uint32_t sign = signs >> i & 1;
    if (i == 0 && has_byte) {
      values[0] = static_cast<uint8_t>(base + 2 * magnitudes[0] + sign);
      continue;
    }
    const uint32_t difference = sign ? 255 - magnitudes[i] : magnitudes[i];
    values[i] = static_cast<uint8_t>((i == 0 ? before : values[kBefore[i]]) + difference);
  }
}

/// The byte of a half that has one.
uint8_t half_byte(uint8_t first, bool constant, uint32_t planes) {
  if (constant) return first;
  return static_cast<uint8_t>((first & ~((2u << planes) - 1)) | 1u << planes);
}

/// One channel of a line while a group is read.
struct ReadChannel {
  DccForm form;
  uint8_t bytes[kHalves] = {0, 0};
};

/// Takes the bytes of both halves. Returns false if a byte says no number of planes.
bool read_bytes(LowFirstBits& in, ReadChannel& channel) {
  DccForm& form = channel.form;
  if (form.left_byte) channel.bytes[0] = static_cast<uint8_t>(in.get(8));
  if (form.right_byte) channel.bytes[1] = static_cast<uint8_t>(in.get(8));
  form.left_planes = kMostPlanes;
  if (form.left_byte && !form.left_constant) {
    if (channel.bytes[0] == 0) return false;
    form.left_planes = static_cast<uint8_t>(std::countr_zero(channel.bytes[0]));
  }
  form.right_planes = form.left_planes;
  if (form.right_byte && !form.right_constant) {
    if (channel.bytes[1] == 0) return false;
    form.right_planes = static_cast<uint8_t>(std::countr_zero(channel.bytes[1]));
  }
  return true;
}

void read_channel(LowFirstBits& in, const ReadChannel& channel, uint8_t (&values)[kHalves][kHalfPixels]) {
  const DccForm& form = channel.form;
  uint8_t before = 0;
  for (uint32_t half = 0; half < kHalves; ++half) {
    const bool has_byte = half == 0 ? form.left_byte : form.right_byte;
    const bool constant = half == 0 ? form.left_constant : form.right_constant;
    const uint32_t planes = half == 0 ? form.left_planes : form.right_planes;
    if (constant) {
      std::fill_n(values[half], kHalfPixels, has_byte ? channel.bytes[half] : before);
    } else {
      const auto base = static_cast<uint8_t>(channel.bytes[half] & ~((2u << planes) - 1));
      read_half(in, has_byte, base, before, planes, values[half]);
    }
    before = values[half][kLastUpper];
  }
}

/// What the loops over the lanes find. A lane is a channel of a line, 4l + c.
struct LaneFigures {
  uint8_t magnitudes[kHalves][kLanes] = {};  ///< OR over the half
  uint8_t changes[kHalves][kLanes] = {};     ///< OR of differences: 0 = constant
  uint8_t between[kLanes] = {};              ///< u0 of the right half − u3 of the left half
};

LaneFigures lane_figures(const DccBlock& block) {
  LaneFigures found;
  for (uint32_t half = 0; half < kHalves; ++half)
    for (uint32_t i = 1; i < kHalfPixels; ++i) {
      const uint8_t* values = block.values[i][half];
      const uint8_t* before = block.values[kBefore[i]][half];
      for (uint32_t lane = 0; lane < kLanes; ++lane) {
        const auto difference = static_cast<uint8_t>(values[lane] - before[lane]);
        found.changes[half][lane] |= difference;
        found.magnitudes[half][lane] |= magnitude_of(difference);
      }
    }
  for (uint32_t lane = 0; lane < kLanes; ++lane)
    found.between[lane] = static_cast<uint8_t>(block.values[0][1][lane] - block.values[kLastUpper][0][lane]);
  return found;
}

}  // namespace

DccBlock dcc_analyse(const uint32_t* pixels) {
  DccBlock block;
  for (uint32_t line = 0; line < kDccLines; ++line)
    for (uint32_t at = 0; at < kDccLinePixels; ++at) {
      const uint32_t channels = to_channels(pixels[line * kDccLinePixels + at]);
      uint8_t* to = &block.values[at % kHalfPixels][at / kHalfPixels][line * kChannels];
      for (uint32_t c = 0; c < kChannels; ++c) to[c] = static_cast<uint8_t>(channels >> 8 * c);
    }
  const LaneFigures found = lane_figures(block);
  block.line_bytes.fill(kFlagBytes);
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    const uint8_t left = found.magnitudes[0][lane], right = found.magnitudes[1][lane];
    const uint8_t both = left | right | magnitude_of(found.between[lane]);
    block.forms[lane] = smallest_form({.left_constant = found.changes[0][lane] == 0,
                                       .right_constant = found.changes[1][lane] == 0,
                                       .left_zero = block.values[0][0][lane] == 0,
                                       .right_continues = found.between[lane] == 0,
                                       .left_planes = planes_for(left),
                                       .right_planes = planes_for(right),
                                       .joint_planes = planes_for(both)});
    block.line_bytes[lane / kChannels] += block.forms[lane].bytes();
  }
  return block;
}

void dcc_write_group(const DccBlock& block, uint32_t first, uint32_t count, BitWriter& out) {
  LowFirstBits bits;
  const uint32_t begin = first * kChannels, end = begin + count * kChannels;
  for (uint32_t line = begin; line < end; line += kChannels) {
    for (uint32_t c = 0; c < kChannels; ++c)
      bits.put(block.forms[line + c].left_byte | block.forms[line + c].right_byte << 1, 2);
    for (uint32_t c = 0; c < kChannels; ++c)
      bits.put(block.forms[line + c].left_constant | block.forms[line + c].right_constant << 1, 2);
  }
  for (uint32_t lane = begin; lane < end; ++lane) {
    const DccForm& form = block.forms[lane];
    const auto put_byte = [&](uint32_t half, bool constant, uint32_t planes) {
      bits.put(half_byte(block.values[0][half][lane], constant, planes), 8);
    };
    if (form.left_byte) put_byte(0, form.left_constant, form.left_planes);
    if (form.right_byte) put_byte(1, form.right_constant, form.right_planes);
  }
  for (uint32_t lane = begin; lane < end; ++lane) {
    const DccForm& form = block.forms[lane];
    uint8_t halves[kHalves][kHalfPixels];
    for (uint32_t half = 0; half < kHalves; ++half)
      for (uint32_t i = 0; i < kHalfPixels; ++i) halves[half][i] = block.values[i][half][lane];
    if (!form.left_constant) write_half(halves[0], form.left_byte, 0, form.left_planes, bits);
    if (!form.right_constant)
      write_half(halves[1], form.right_byte, halves[0][kLastUpper], form.right_planes, bits);
  }
  bits.write(out, kDccGroupBytes);
}

bool dcc_read_group(BitReader& in, uint32_t count, uint32_t* pixels) {
  LowFirstBits bits = LowFirstBits::read(in, kDccGroupBytes);
  std::array<ReadChannel, kLanes> channels;
  const uint32_t lanes = count * kChannels;
  for (uint32_t line = 0; line < lanes; line += kChannels) {
    for (uint32_t c = 0; c < kChannels; ++c) {
      channels[line + c].form.left_byte = static_cast<uint8_t>(bits.get(1));
      channels[line + c].form.right_byte = static_cast<uint8_t>(bits.get(1));
    }
    for (uint32_t c = 0; c < kChannels; ++c) {
      channels[line + c].form.left_constant = static_cast<uint8_t>(bits.get(1));
      channels[line + c].form.right_constant = static_cast<uint8_t>(bits.get(1));
    }
  }
  for (uint32_t lane = 0; lane < lanes; ++lane)
    if (!observed(channels[lane].form) || !read_bytes(bits, channels[lane])) return false;
  std::fill_n(pixels, count * kDccLinePixels, 0);
  for (uint32_t lane = 0; lane < lanes; ++lane) {
    uint8_t values[kHalves][kHalfPixels];
    read_channel(bits, channels[lane], values);
    uint32_t* line = pixels + lane / kChannels * kDccLinePixels;
    for (uint32_t i = 0; i < kDccLinePixels; ++i)
      line[i] |= uint32_t{values[i / kHalfPixels][i % kHalfPixels]} << 8 * (lane % kChannels);
  }
  for (uint32_t i = 0; i < count * kDccLinePixels; ++i) pixels[i] = from_channels(pixels[i]);
  return !bits.overran();
}

}  // namespace tilepress
