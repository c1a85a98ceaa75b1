// MSAA: runs of equal pixels, or runs of two colours, of one length for the block (ATTILA GPU simulator).
//
//   CSB       3 bits: the level; 5 = raw
//   payload   the runs of the level, then zeros up to its size; or 64 raw pixels
//               level  runs        of colours  a run                      size
//               0      16 of 4      1          |color 32|                  512
//               1       4 of 16     2          |a 32|b 32|mark 1| 16 ×     512
//               2      32 of 2      1          |color 32|                 1024
//               3       8 of 8      2          |a 32|b 32|mark 1| 8 ×     1024
//               4      16 of 4      2          |a 32|b 32|mark 1| 4 ×     1536
//   tables    none
//
// Modelling decisions. Runs are in traversal order, so a run of 4 is a sub-block. The lowest level whose
// every run has no more colours wins. a is the first pixel of the run, b the first that differs, or a again
// if none does; a mark is 1 for b. The order of the fields is ours.
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kPixelBits = 32, kCsbBits = 3;

struct Level {
  uint32_t run, colors, bits;
};
constexpr Level kLevels[] = {{4, 1, 512}, {16, 2, 512}, {2, 1, 1024}, {8, 2, 1024}, {4, 2, 1536}};
constexpr uint32_t kLastLevel = 4, kRawLevel = 5;
constexpr uint32_t kRawBits = kBlockPixels * kPixelBits;

/// Returns the first pixel that differs from the first of the run; the first itself if none does.
uint32_t second_color(const uint32_t* run, uint32_t length) {
  for (uint32_t i = 1; i < length; ++i)
    if (run[i] != run[0]) return run[i];
  return run[0];
}

bool run_fits(const uint32_t* run, const Level& level) {
  const uint32_t a = run[0], b = level.colors == 1 ? a : second_color(run, level.run);
  bool fits = true;
  for (uint32_t i = 1; i < level.run; ++i) fits &= (run[i] == a) | (run[i] == b);
  return fits;
}

bool block_fits(const uint32_t* pixels, const Level& level) {
  for (uint32_t i = 0; i < kBlockPixels; i += level.run)
    if (!run_fits(pixels + i, level)) return false;
  return true;
}

uint32_t level_of(const BlockContext& block) {
  if (block.uniform) return 0;
  // A block that fits a level fits the last one too.
  if (!block_fits(block.pixels, kLevels[kLastLevel])) return kRawLevel;
  uint32_t level = 0;
  while (level < kLastLevel && !block_fits(block.pixels, kLevels[level])) ++level;
  return level;
}

class MsaaEncoder final : public BlockEncoder {
 public:
  MsaaEncoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  uint32_t csb_bits() const override { return kCsbBits; }
  uint32_t measure(const BlockContext& block) const override {
    const uint32_t level = level_of(block);
    return level == kRawLevel ? kRawBits : kLevels[level].bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const uint32_t number = level_of(block);
    csb.put(number, kCsbBits);
    if (number == kRawLevel) return write_raw_block(block.pixels, kPixelBits, payload);
    const Level& level = kLevels[number];
    const uint64_t end = payload.bit_count() + level.bits;
    for (const uint32_t* run = block.pixels; run < block.pixels + kBlockPixels; run += level.run) {
      payload.put(run[0], kPixelBits);
      if (level.colors == 1) continue;
      payload.put(second_color(run, level.run), kPixelBits);
      for (uint32_t i = 0; i < level.run; ++i) payload.put(run[i] != run[0], 1);
    }
    payload.pad_to(end);
  }
};

class MsaaDecoder final : public BlockDecoder {
 public:
  MsaaDecoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kCsbBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto number = static_cast<uint32_t>(csb.get(kCsbBits));
    if (number > kRawLevel) return false;
    if (number == kRawLevel) {
      read_raw_block(payload, kPixelBits, out);
      return !csb.overran() && !payload.overran();
    }
    const Level& level = kLevels[number];
    const uint64_t end = payload.position() + level.bits;
    for (uint32_t begin = 0; begin < kBlockPixels; begin += level.run) {
      const auto a = static_cast<uint32_t>(payload.get(kPixelBits));
      const auto b = level.colors == 1 ? a : static_cast<uint32_t>(payload.get(kPixelBits));
      for (uint32_t i = 0; i < level.run; ++i) {
        const bool second = level.colors == 2 && payload.get(1) != 0;
        out.pixels[kTraversal[begin + i]] = second ? b : a;
      }
    }
    payload.skip(end - payload.position());
    return !csb.overran() && !payload.overran();
  }
};

}  // namespace

const SchemeInfo kMsaaInfo = {
    .name = "msaa",
    .label = "MSAA",
    .family = "attila",
    .group = SchemeGroup::kLiterature,
    .summary = "runs of equal pixels, or of two colours, of one length for the block",
    .source = "ATTILA GPU simulator",
    .make_encoder = make_encoder<MsaaEncoder>,
    .make_decoder = make_decoder<MsaaDecoder>,
    .eight_bit_only = true};

}  // namespace tilepress
