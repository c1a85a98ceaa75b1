// Intel11: the colour compression (CCS) of Intel's 11th generation, as reverse engineered by Wang et al.
//
//   CSB       4 bits for each pair of memory lines (8×4 pixels), its mode:
//                1  the pair in 256 bits      6  the pair in 512 bits     10  each line in 256 bits
//                2  the left line in 256 bits, the right line raw      8  the right line in 256 bits, the
//                left raw 0  raw
//   payload   the pairs in order, rows 0–3, then rows 4–7; in a pair the left line first. Units as
//             intel11_unit.h draws them; a raw line has 512 bits: row by row, 4 bytes R, G, B, A a pixel
//   tables    none
//
// Modelling decisions. The format is known from the published decoder, not from Intel, and not all of it.
// Which mode the hardware prefers is unknown: each pair takes its smallest legal mode, so the sizes are a
// bound. Among equal sizes the order is 10, 6, and for each unit plain, inter, extended, extended inter. The
// extension flags the first four blocks of one colour, because exactly four were ever seen. Our choices
// besides: 0 for a raw pair, the order of lines, and where the differences of a pixel stand with inter = 1.
#include <optional>

#include "intel/intel11_unit.h"
#include "intel/pixel_pair.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kModeBits = 4;
enum Mode : uint32_t {
  kRawPair = 0,
  kPairInHalfLine = 1,
  kFirstLineInHalf = 2,
  kPairInLine = 6,
  kSecondLineInHalf = 8,
  kBothLinesInHalves = 10
};

constexpr bool has_line_in_half(uint32_t mode, uint32_t line) {
  return mode == kBothLinesInHalves || mode == (line == 0 ? kFirstLineInHalf : kSecondLineInHalf);
}
constexpr uint32_t mode_bits(uint32_t mode) {
  switch (mode) {
    case kPairInHalfLine:
      return 256;
    case kPairInLine:
    case kBothLinesInHalves:
      return 512;
    case kFirstLineInHalf:
    case kSecondLineInHalf:
      return 768;
    default:
      return 1024;
  }
}

/// Returns bases whose differences take at most `bits`, plain ones if both do.
std::optional<Intel11Bases> bases_within(const Intel11Ranges& ranges, uint32_t bits) {
  if (const Intel11Bases plain = plain_bases(ranges); plain.bits() <= bits) return plain;
  if (const Intel11Bases inter = inter_bases(ranges); inter.bits() <= bits) return inter;
  return std::nullopt;
}

/// The mode of a pair, and what its units need.
struct PairForm {
  uint32_t mode = kRawPair;
  std::array<std::optional<Intel11Bases>, kPairLines> bases;  ///< of each line, or [0] of the pair
  uint32_t extension = 0;
};

PairForm smallest_form(const uint32_t* pair) {
  const Intel11Ranges lines[] = {intel11_ranges(pair, 0), intel11_ranges(pair, 1)};
  const Intel11Ranges both = united(lines[0], lines[1]);
  if (const auto bases = bases_within(both, kIntel11Pair32.slot_bits)) return {kPairInHalfLine, {bases, {}}};
  PairForm form;
  for (uint32_t line = 0; line < kPairLines; ++line)
    form.bases[line] = bases_within(lines[line], intel11_line(line).slot_bits);
  if (form.bases[0] && form.bases[1]) {
    form.mode = kBothLinesInHalves;
    return form;
  }
  if (const auto bases = bases_within(both, kIntel11Pair64.slot_bits)) return {kPairInLine, {bases, {}}};
  if (const uint32_t extension = intel11_extension(pair); extension != 0)
    if (const auto bases = bases_within(both, kExtendedSlotBits))
      return {kPairInLine, {bases, {}}, extension};
  if (form.bases[0]) form.mode = kFirstLineInHalf;
  if (form.bases[1]) form.mode = kSecondLineInHalf;
  return form;
}

void write_form(const uint32_t* pair, const PairForm& form, BitWriter& out) {
  if (form.mode == kPairInHalfLine || form.mode == kPairInLine) {
    const Intel11Layout& layout = form.mode == kPairInLine ? kIntel11Pair64 : kIntel11Pair32;
    return intel11_write(pair, layout, *form.bases[0], form.extension, out);
  }
  for (uint32_t line = 0; line < kPairLines; ++line) {
    if (has_line_in_half(form.mode, line))
      intel11_write(pair, intel11_line(line), *form.bases[line], 0, out);
    else
      write_raw_pair_line(pair, line, out);
  }
}

/// Returns false if no encoder writes these bits.
bool read_pair(BitReader& in, uint32_t mode, uint32_t* pair) {
  if (mode == kPairInHalfLine) return intel11_read(in, kIntel11Pair32, pair);
  if (mode == kPairInLine) return intel11_read(in, kIntel11Pair64, pair);
  if (mode != kRawPair && !has_line_in_half(mode, 0) && !has_line_in_half(mode, 1)) return false;
  for (uint32_t line = 0; line < kPairLines; ++line) {
    if (!has_line_in_half(mode, line))
      read_raw_pair_line(in, line, pair);
    else if (!intel11_read(in, intel11_line(line), pair))
      return false;
  }
  return true;
}

class Intel11Encoder final : public BlockEncoder {
 public:
  Intel11Encoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  uint32_t csb_bits() const override { return kPairs * kModeBits; }
  uint32_t measure(const BlockContext& block) const override {
    return mode_bits(smallest_form(block.pixels).mode) +
           mode_bits(smallest_form(block.pixels + kPairPixels).mode);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t i = 0; i < kPairs; ++i) {
      const uint32_t* pair = block.pixels + i * kPairPixels;
      const PairForm form = smallest_form(pair);
      csb.put(form.mode, kModeBits);
      write_form(pair, form, payload);
    }
  }
};

class Intel11Decoder final : public BlockDecoder {
 public:
  Intel11Decoder(const SchemeSpec&, const FormatTraits&, const ModelOptions&) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kPairs * kModeBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t i = 0; i < kPairs; ++i) {
      uint32_t pair[kPairPixels];
      if (!read_pair(payload, static_cast<uint32_t>(csb.get(kModeBits)), pair)) return false;
      place_pair(pair, i, out);
    }
    return !csb.overran() && !payload.overran();
  }
};

}  // namespace

const SchemeInfo kIntel11Info = {
    .name = "intel11",
    .label = "Intel 11",
    .family = "intel",
    .group = SchemeGroup::kHardware,
    .summary = "Intel's 11th-generation CCS, as reverse engineered: 8x4 pixels in 32, 64, 96 or 128 bytes",
    .source = "Wang et al. 2024 (GPU.zip), as reverse engineered",
    .make_encoder = make_encoder<Intel11Encoder>,
    .make_decoder = make_decoder<Intel11Decoder>,
    .eight_bit_only = true};

}  // namespace tilepress
