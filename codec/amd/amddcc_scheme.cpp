// AmdDcc: delta colour compression (DCC) of AMD's Renoir, as reverse engineered by Wang et al.
//
//   CSB       8 bits, how the block's four lines of 8×2 pixels share 64-byte lines of memory:
//               28 all four in one | CC three, one | CD one, three | 67 two, two
//               66 two, one, one | 65 one, two, one | 64 one, one, two | 00 raw            (hexadecimal)
//   payload   the groups from top to bottom, 512 bits each: several lines as dcc_line.h draws them; a line
//             alone raw, its pixels row by row, 4 bytes R, G, B, A a pixel
//   tables    none
//
// Modelling decisions. The format is known from the published decoder, not from AMD, and not all of it.
// Groups are runs of consecutive lines; that, and the values of the CSB except 28, CC and 66, are our choice.
// How the hardware chooses is unknown: each channel takes its smallest form, and the block the smallest
// total, so the sizes are a bound. Among equal totals the order is the one above. Among equal forms a half
// has a byte before it has none; the right half of a channel without a constant half is the exception. Six of
// the sixteen flag combinations were never observed (dcc_line.cpp): they are not written, and the decoder
// refuses them.
#include <algorithm>

#include "amd/dcc_line.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kCsbBits = 8;

/// How the lines form groups; smaller totals first.
struct Split {
  uint8_t code;
  uint8_t groups;
  std::array<uint8_t, kDccLines> lines;  ///< of each group
};
constexpr Split kSplits[] = {{0x28, 1, {4}},       {0xCC, 2, {3, 1}},      {0xCD, 2, {1, 3}},
                             {0x67, 2, {2, 2}},    {0x66, 3, {2, 1, 1}},   {0x65, 3, {1, 2, 1}},
                             {0x64, 3, {1, 1, 2}}, {0x00, 4, {1, 1, 1, 1}}};

bool fits(const Split& split, const DccBlock& block) {
  uint32_t line = 0;
  for (uint32_t group = 0; group < split.groups; ++group) {
    uint32_t bytes = 0;
    for (uint32_t i = 0; i < split.lines[group]; ++i) bytes += block.line_bytes[line++];
    if (split.lines[group] > 1 && bytes > kDccGroupBytes) return false;
  }
  return true;
}
const Split& smallest_split(const DccBlock& block) {
  return *std::find_if(std::begin(kSplits), std::end(kSplits) - 1,
                       [&](const Split& split) { return fits(split, block); });
}

/// Returns the position among a line's pixels in traversal order of pixel `i` row by row.
constexpr uint32_t row_pixel(uint32_t i) {
  const uint32_t x = i % kBlockSide, y = i / kBlockSide;
  return x / 2 * kSubBlockPixels + 2 * y + x % 2;
}

class AmdDccEncoder final : public BlockEncoder {
 public:
  AmdDccEncoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  uint32_t csb_bits() const override { return kCsbBits; }
  uint32_t measure(const BlockContext& block) const override {
    return smallest_split(dcc_analyse(block.pixels)).groups * kDccGroupBytes * 8;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const DccBlock lines = dcc_analyse(block.pixels);
    const Split& split = smallest_split(lines);
    csb.put(split.code, kCsbBits);
    uint32_t line = 0;
    for (uint32_t group = 0; group < split.groups; line += split.lines[group++]) {
      if (split.lines[group] > 1) {
        dcc_write_group(lines, line, split.lines[group], payload);
        continue;
      }
      LowFirstBits raw;
      for (uint32_t i = 0; i < kDccLinePixels; ++i)
        raw.put(block.pixels[line * kDccLinePixels + row_pixel(i)], 32);
      raw.write(payload, kDccGroupBytes);
    }
  }
};

class AmdDccDecoder final : public BlockDecoder {
 public:
  AmdDccDecoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kCsbBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const uint64_t code = csb.get(kCsbBits);
    const auto split = std::find_if(std::begin(kSplits), std::end(kSplits),
                                    [&](const Split& each) { return each.code == code; });
    if (split == std::end(kSplits)) return false;
    uint32_t pixels[kBlockPixels], line = 0;
    for (uint32_t group = 0; group < split->groups; line += split->lines[group++]) {
      uint32_t* to = pixels + line * kDccLinePixels;
      if (split->lines[group] > 1) {
        if (!dcc_read_group(payload, split->lines[group], to)) return false;
        continue;
      }
      LowFirstBits raw = LowFirstBits::read(payload, kDccGroupBytes);
      for (uint32_t i = 0; i < kDccLinePixels; ++i) to[row_pixel(i)] = raw.get(32);
    }
    for (uint32_t i = 0; i < kBlockPixels; ++i) out.pixels[kTraversal[i]] = pixels[i];
    return !csb.overran() && !payload.overran();
  }
};

}  // namespace

const SchemeInfo kAmdDccInfo = {
    .name = "amddcc",
    .label = "AMD DCC",
    .family = "amd",
    .group = SchemeGroup::kHardware,
    .summary =
        "AMD's delta colour compression (Renoir), as reverse engineered: two to four lines in 64 bytes",
    .source = "Wang et al. 2024 (GPU.zip), as reverse engineered",
    .make_encoder = make_encoder<AmdDccEncoder>,
    .make_decoder = make_decoder<AmdDccDecoder>,
    .eight_bit_only = true};

}  // namespace tilepress
