// BDI: base-delta-immediate compression of 64-byte lines (Pekhimenko et al. 2012).
//
//   CSB       4 bits for each 64-byte line, its code; four lines for 32-bit pixels, two for 16-bit
//   payload   the lines in order
//               code  name   payload bits
//               0     zeros    0
//               1     rep8    64                          one 8-byte value, repeated
//               2     B8D1    64 +  8 · (1 +  8) = 136
//               3     B8D2    64 +  8 · (1 + 16) = 200
//               4     B8D4    64 +  8 · (1 + 32) = 328
//               5     B4D1    32 + 16 · (1 +  8) = 176
//               6     B4D2    32 + 16 · (1 + 16) = 304
//               7     B2D1    16 + 32 · (1 +  8) = 304
//               15    raw    512
//             BkDj: the base (k bytes); a mask bit for each element of k bytes, 1 = from the base, 0 = from
//             zero (the "immediate"); then a delta of j bytes each, sign-extended, added modulo 2^8k
//   tables    none
//
// Modelling decisions. The mask counts: the original's table of sizes leaves it out, but a decoder needs it.
// The base is the first element that is not a sign-extended delta from zero; elements that are use the
// immediate. The encoding with the fewest bits wins; ties go to the lowest code, and the line is raw if no
// encoding is smaller. A zero line has only its code (the original stores one byte). Lines take the block's
// pixels row by row, two rows of 32-bit pixels per line; `order=quad` takes them in traversal order.
#include <optional>

#include "pixels/memory_lines.h"
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kLineWords = 16;  ///< 64 bytes
constexpr uint32_t kCodeBits = 4;
enum BdiCode : uint32_t { kZeros = 0, kRep8 = 1, kFirstBase = 2, kLastBase = 7, kRawLine = 15 };

struct BaseDelta {
  uint32_t base_bits, delta_bits;
  uint32_t elements() const { return 512 / base_bits; }
  uint32_t bits() const { return base_bits + elements() * (1 + delta_bits); }
};
constexpr BaseDelta kBaseDeltas[] = {{64, 8}, {64, 16}, {64, 32},
                                     {32, 8}, {32, 16}, {16, 8}};  // from kFirstBase

/// Returns element `i` of `bits` bits of a line.
uint64_t element(const uint32_t* line, uint32_t bits, uint32_t i) {
  if (bits == 64) return uint64_t{line[2 * i]} | uint64_t{line[2 * i + 1]} << 32;
  if (bits == 32) return line[i];
  return line[i / 2] >> 16 * (i % 2) & 0xFFFFu;
}

uint64_t low_bits(uint64_t value, uint32_t bits) {
  return bits == 64 ? value : value & ((uint64_t{1} << bits) - 1);
}
uint64_t sign_extend(uint64_t value, uint32_t from, uint32_t to) {
  const uint64_t sign = uint64_t{1} << (from - 1);
  return low_bits((low_bits(value, from) ^ sign) - sign, to);
}
bool fits(uint64_t value, const BaseDelta& code) {
  return sign_extend(value, code.delta_bits, code.base_bits) == value;
}

/// Returns the base with which `code` represents the line, or nothing if it cannot.
std::optional<uint64_t> base_of(const uint32_t* line, const BaseDelta& code) {
  std::optional<uint64_t> base;
  for (uint32_t i = 0; i < code.elements(); ++i) {
    const uint64_t value = element(line, code.base_bits, i);
    if (fits(value, code)) continue;
    if (!base) base = value;
    if (!fits(low_bits(value - *base, code.base_bits), code)) return std::nullopt;
  }
  return base.value_or(0);
}

uint32_t code_bits(uint32_t code) {
  if (code == kZeros) return 0;
  if (code == kRep8) return 64;
  return code == kRawLine ? 512 : kBaseDeltas[code - kFirstBase].bits();
}

uint32_t choose_code(const uint32_t* line) {
  bool repeated = true, zero = line[0] == 0 && line[1] == 0;
  for (uint32_t i = 2; i < kLineWords; ++i) repeated &= line[i] == line[i - 2];
  if (repeated) return zero ? kZeros : kRep8;
  uint32_t best = kRawLine;
  for (uint32_t code = kFirstBase; code <= kLastBase; ++code)
    if (code_bits(code) < code_bits(best) && base_of(line, kBaseDeltas[code - kFirstBase])) best = code;
  return best;
}

void put_wide(BitWriter& out, uint64_t value, uint32_t bits) {
  if (bits > 32) out.put(value >> 32, bits - 32);
  out.put(value & (bits >= 32 ? 0xFFFFFFFFu : (uint64_t{1} << bits) - 1), bits < 32 ? bits : 32);
}
uint64_t get_wide(BitReader& in, uint32_t bits) {
  const uint64_t high = bits > 32 ? in.get(bits - 32) : 0;
  return high << 32 | in.get(bits < 32 ? bits : 32);
}

void write_line(const uint32_t* line, uint32_t code, BitWriter& out) {
  if (code == kZeros) return;
  if (code == kRep8) return put_wide(out, element(line, 64, 0), 64);
  if (code == kRawLine) {
    for (uint32_t i = 0; i < kLineWords; ++i) out.put(line[i], 32);
    return;
  }
  const BaseDelta& form = kBaseDeltas[code - kFirstBase];
  const uint64_t base = *base_of(line, form);
  put_wide(out, base, form.base_bits);
  for (uint32_t i = 0; i < form.elements(); ++i) out.put(!fits(element(line, form.base_bits, i), form), 1);
  for (uint32_t i = 0; i < form.elements(); ++i) {
    const uint64_t value = element(line, form.base_bits, i);
    out.put(low_bits(fits(value, form) ? value : value - base, form.delta_bits), form.delta_bits);
  }
}

bool read_line(BitReader& in, uint32_t code, uint32_t* line) {
  for (uint32_t i = 0; i < kLineWords; ++i) line[i] = 0;
  if (code == kZeros) return true;
  if (code == kRep8) {
    const uint64_t value = get_wide(in, 64);
    for (uint32_t i = 0; i < kLineWords; ++i) line[i] = static_cast<uint32_t>(value >> 32 * (i % 2));
    return true;
  }
  if (code == kRawLine) {
    for (uint32_t i = 0; i < kLineWords; ++i) line[i] = static_cast<uint32_t>(in.get(32));
    return true;
  }
  if (code > kLastBase) return false;
  const BaseDelta& form = kBaseDeltas[code - kFirstBase];
  const uint64_t base = get_wide(in, form.base_bits);
  const uint64_t mask = in.get(form.elements());  // at most 32
  for (uint32_t i = 0; i < form.elements(); ++i) {
    const bool from_base = (mask >> (form.elements() - 1 - i) & 1) != 0;
    const uint64_t delta = sign_extend(in.get(form.delta_bits), form.delta_bits, form.base_bits);
    const uint64_t value = low_bits(delta + (from_base ? base : 0), form.base_bits);
    if (form.base_bits == 64) {
      line[2 * i] = static_cast<uint32_t>(value);
      line[2 * i + 1] = static_cast<uint32_t>(value >> 32);
    } else if (form.base_bits == 32) {
      line[i] = static_cast<uint32_t>(value);
    } else {
      line[i / 2] |= static_cast<uint32_t>(value) << 16 * (i % 2);
    }
  }
  return true;
}

class BdiEncoder final : public BlockEncoder {
 public:
  BdiEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : order_(line_order(spec)), pixel_bits_(format.pixel_bits) {}

  uint32_t csb_bits() const override { return kBlockPixels * pixel_bits_ / 512 * kCodeBits; }
  uint32_t measure(const BlockContext& block) const override {
    const LineWords lines = to_line_words(block.raster(), order_, pixel_bits_);
    if (block.uniform) return lines.count / kLineWords * code_bits(choose_code(lines.words.data()));
    uint32_t bits = 0;
    for (uint32_t i = 0; i < lines.count; i += kLineWords) bits += code_bits(choose_code(&lines.words[i]));
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const LineWords lines = to_line_words(block.raster(), order_, pixel_bits_);
    for (uint32_t i = 0; i < lines.count; i += kLineWords) {
      const uint32_t code = choose_code(&lines.words[i]);
      csb.put(code, kCodeBits);
      write_line(&lines.words[i], code, payload);
    }
  }

 private:
  const LineOrder order_;
  const uint32_t pixel_bits_;
};

class BdiDecoder final : public BlockDecoder {
 public:
  BdiDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : order_(line_order(spec)), pixel_bits_(format.pixel_bits) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == kBlockPixels * pixel_bits_ / 512 * kCodeBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    LineWords lines;
    lines.count = kBlockPixels * pixel_bits_ / 32;
    for (uint32_t i = 0; i < lines.count; i += kLineWords)
      if (!read_line(payload, static_cast<uint32_t>(csb.get(kCodeBits)), &lines.words[i])) return false;
    from_line_words(lines, order_, pixel_bits_, out);
    return !csb.overran() && !payload.overran();
  }

 private:
  const LineOrder order_;
  const uint32_t pixel_bits_;
};

}  // namespace

const SchemeInfo kBdiInfo = {.name = "bdi",
                             .label = "BDI",
                             .family = "lines",
                             .group = SchemeGroup::kLiterature,
                             .summary = "base-delta-immediate on 64-byte lines of the block, masks counted",
                             .source = "Pekhimenko et al. 2012",
                             .make_encoder = make_encoder<BdiEncoder>,
                             .make_decoder = make_decoder<BdiDecoder>,
                             .keys = kOrderKey};

}  // namespace tilepress
