// FPC-D: frequent pattern compression with a dictionary of the two words before (Alameldeen and Agarwal
// 2018).
//
//   CSB, payload, tables    see pixels/sized_lines.h; four lines of 16 words
//   stream of a line        for each word a 4-bit prefix, then bytes of the word, the highest first
//               prefix  word   bytes behind the prefix
//               0       ZZZZ   none
//               1       FFFF   none
//               2       MMMM   none; the word before
//               3       MMMM   none; the last but one
//               4       ZZZX   1
//               5       XZZZ   1
//               6       RRRR   1
//               7       MMMX   1; the word before
//               8       MMMX   1; the last but one
//               9       ZZXX   2
//               10      ZXZX   2
//               11      FFXX   2
//               12      XXZZ   2
//               13      MMXX   2; the word before
//               14      MMXX   2; the last but one
//               15      XXXX   4
//             A letter is a byte, the highest first: Z is 0, F is 255, X is stored, M is the same byte of an
//             earlier word, R repeats.
//
// Modelling decisions. Our sources give the forms, not their prefixes: the numbers are ours. The form with
// the fewest bytes wins; ties go to the lowest prefix. A line begins with two zeros before its first word. A
// line whose stream takes 64 bytes or more is raw. Lines take the block's pixels row by row, two rows per
// line; `order=quad` takes them in traversal order.
#include <algorithm>
#include <array>
#include <bit>

#include "pixels/sized_lines.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kPrefixBits = 4;

/// A form: the stream has the bytes of the mask `stored`, the source has the others.
struct Form {
  enum Source : uint8_t { kZero, kOnes, kBefore, kLastButOne, kRepeat };
  Source source;
  uint32_t stored;
};
constexpr std::array<Form, 16> kForms = {{{Form::kZero, 0},
                                          {Form::kOnes, 0},
                                          {Form::kBefore, 0},
                                          {Form::kLastButOne, 0},
                                          {Form::kZero, 0x000000FF},
                                          {Form::kZero, 0xFF000000},
                                          {Form::kRepeat, 0x000000FF},
                                          {Form::kBefore, 0x000000FF},
                                          {Form::kLastButOne, 0x000000FF},
                                          {Form::kZero, 0x0000FFFF},
                                          {Form::kZero, 0x00FF00FF},
                                          {Form::kOnes, 0x0000FFFF},
                                          {Form::kZero, 0xFFFF0000},
                                          {Form::kBefore, 0x0000FFFF},
                                          {Form::kLastButOne, 0x0000FFFF},
                                          {Form::kZero, 0xFFFFFFFF}}};

/// Returns the bits behind the prefix.
constexpr uint32_t bits_behind(const Form& form) {
  return static_cast<uint32_t>(std::popcount(form.stored));
}

/// Returns the word with which `form` fills the bytes that it does not store.
uint32_t filling(const Form& form, uint32_t stored, uint32_t before, uint32_t last_but_one) {
  switch (form.source) {
    case Form::kOnes:
      return ~0u;
    case Form::kBefore:
      return before;
    case Form::kLastButOne:
      return last_but_one;
    case Form::kRepeat:
      return (stored & 0xFF) * 0x01010101;
    default:
      return 0;
  }
}

uint32_t prefix_of(uint32_t word, uint32_t before, uint32_t last_but_one) {
  uint32_t prefix = 0;
  for (const Form& form : kForms) {
    const uint32_t other = word ^ filling(form, word, before, last_but_one);
    if ((other & ~form.stored) == 0) break;
    ++prefix;
  }
  return prefix;
}

/// Returns the bits of a word. No branches, for loops over words.
constexpr uint32_t word_bits(uint32_t word, uint32_t before, uint32_t last_but_one) {
  const uint32_t a = word ^ before, b = word ^ last_but_one;
  const bool none = (word == 0) | (word == ~0u) | (a == 0) | (b == 0);
  const bool one = ((word & ~0xFFu) == 0) | ((word & 0xFFFFFF) == 0) | (word == std::rotl(word, 8)) |
                   ((a & ~0xFFu) == 0) | ((b & ~0xFFu) == 0);
  const bool two = ((word & 0xFFFF0000) == 0) | ((word & 0xFF00FF00) == 0) | ((~word & 0xFFFF0000) == 0) |
                   ((word & 0xFFFF) == 0) | ((a & 0xFFFF0000) == 0) | ((b & 0xFFFF0000) == 0);
  uint32_t behind = two ? 16 : 32;
  behind = one ? 8 : behind;
  behind = none ? 0 : behind;
  return kPrefixBits + behind;
}

/// Moves the stored bytes of a form together, to the low end of the word.
uint32_t gathered(uint32_t word, uint32_t stored) {
  if (stored == 0x00FF00FF) return (word >> 8 & 0xFF00) | (word & 0xFF);
  return stored == 0 ? 0 : (word & stored) >> std::countr_zero(stored);
}
uint32_t spread(uint32_t bytes, uint32_t stored) {
  if (stored == 0x00FF00FF) return (bytes & 0xFF00) << 8 | (bytes & 0xFF);
  return stored == 0 ? 0 : bytes << std::countr_zero(stored);
}

struct FpcdLine {
  static constexpr uint32_t kWords = 16, kMostBytes = 63;

  static uint32_t bits(const uint32_t* words) {
    std::array<uint32_t, kWords + 2> line{};
    std::copy_n(words, kWords, line.begin() + 2);
    uint32_t sum = 0;
    for (uint32_t i = 0; i < kWords; ++i) sum += word_bits(line[i + 2], line[i + 1], line[i]);
    return sum;
  }
  static void write(const uint32_t* words, BitWriter& out) {
    uint32_t before = 0, last_but_one = 0;
    for (uint32_t i = 0; i < kWords; ++i) {
      const uint32_t prefix = prefix_of(words[i], before, last_but_one);
      out.put(prefix, kPrefixBits);
      out.put(gathered(words[i], kForms[prefix].stored), bits_behind(kForms[prefix]));
      last_but_one = before;
      before = words[i];
    }
  }
  static bool read(BitReader& in, uint32_t* words) {
    uint32_t before = 0, last_but_one = 0;
    for (uint32_t i = 0; i < kWords; ++i) {
      const Form& form = kForms[in.get(kPrefixBits)];
      const uint32_t stored = spread(static_cast<uint32_t>(in.get(bits_behind(form))), form.stored);
      words[i] = stored | (filling(form, stored, before, last_but_one) & ~form.stored);
      last_but_one = before;
      before = words[i];
    }
    return true;
  }
};

}  // namespace

const SchemeInfo kFpcdInfo = {
    .name = "fpcd",
    .label = "FPC-D",
    .family = "lines",
    .group = SchemeGroup::kLiterature,
    .summary = "frequent pattern compression of 64-byte lines, with matches against the two words before",
    .source = "Alameldeen and Agarwal 2018",
    .make_encoder = make_encoder<SizedLineEncoder<FpcdLine>>,
    .make_decoder = make_decoder<SizedLineDecoder<FpcdLine>>,
    .keys = kOrderKey,
    .eight_bit_only = true};

}  // namespace tilepress
