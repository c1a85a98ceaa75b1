// FPC: frequent pattern compression of 64-byte lines (Alameldeen and Wood 2004).
//
//   CSB, payload, tables    see pixels/sized_lines.h; four lines of 16 words
//   stream of a line        a 3-bit prefix, then
//               prefix  words                                      bits behind the prefix
//               0       1 to 8 zeros                                3, their number − 1
//               1       one that sign-extends 4 bits                4
//               2       one that sign-extends 8 bits                8
//               3       one that sign-extends 16 bits              16
//               4       one whose low half is zero                 16, the high half
//               5       two halves that sign-extend 8 bits each    16, high half first
//               6       four equal bytes                            8
//               7       any                                        32
//
// Modelling decisions. The form with the fewest bits wins; ties go to the lowest prefix. A run of zeros ends
// with the line. A line whose stream takes 64 bytes or more is raw. Lines take the block's pixels row by row,
// two rows per line; `order=quad` takes them in traversal order.
#include <bit>

#include "pixels/sized_lines.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kPrefixBits = 3, kRunBits = 3, kLongestRun = 8;
enum FpcPrefix : uint32_t { kZeros, kSign4, kSign8, kSign16, kHighHalf, kTwoBytes, kEqualBytes, kAnyWord };
constexpr uint32_t kBitsBehind[] = {kRunBits, 4, 8, 16, 16, 16, 8, 32};

/// True if the word sign-extends its low `bits` bits.
constexpr bool extends(uint32_t word, uint32_t bits) {
  return ((word + (1u << (bits - 1))) & ~0u << bits) == 0;
}
constexpr bool has_two_bytes(uint32_t word) {
  const uint32_t low = (word & 0xFFFF) + 0x80, high = (word >> 16) + 0x80;
  return ((low | high) & 0xFF00) == 0;
}
constexpr bool has_equal_bytes(uint32_t word) {
  return word == std::rotl(word, 8);
}

/// Returns the bits of a word other than zero. No branches, for loops over words.
constexpr uint32_t word_bits(uint32_t word) {
  uint32_t behind = has_two_bytes(word) ? 16 : 32;
  behind = (word & 0xFFFF) == 0 ? 16 : behind;
  behind = extends(word, 16) ? 16 : behind;
  behind = has_equal_bytes(word) ? 8 : behind;
  behind = extends(word, 8) ? 8 : behind;
  behind = extends(word, 4) ? 4 : behind;
  return kPrefixBits + behind;
}

/// Returns the prefix of a word other than zero.
FpcPrefix prefix_of(uint32_t word) {
  if (extends(word, 4)) return kSign4;
  if (extends(word, 8)) return kSign8;
  if (has_equal_bytes(word)) return kEqualBytes;
  if (extends(word, 16)) return kSign16;
  if ((word & 0xFFFF) == 0) return kHighHalf;
  return has_two_bytes(word) ? kTwoBytes : kAnyWord;
}

/// Returns what follows the prefix of a word other than zero.
uint32_t behind_prefix(uint32_t word, FpcPrefix prefix) {
  switch (prefix) {
    case kHighHalf:
      return word >> 16;
    case kTwoBytes:
      return (word >> 8 & 0xFF00) | (word & 0xFF);
    default:
      return word & ~0u >> (32 - kBitsBehind[prefix]);
  }
}

uint32_t sign_extended(uint32_t value, uint32_t bits) {
  const uint32_t sign = 1u << (bits - 1);
  return (value ^ sign) - sign;
}

uint32_t word_from(FpcPrefix prefix, uint32_t behind) {
  switch (prefix) {
    case kHighHalf:
      return behind << 16;
    case kTwoBytes:
      return sign_extended(behind >> 8, 8) << 16 | (sign_extended(behind & 0xFF, 8) & 0xFFFF);
    case kEqualBytes:
      return behind * 0x01010101;
    case kAnyWord:
      return behind;
    default:
      return sign_extended(behind, kBitsBehind[prefix]);
  }
}

struct FpcLine {
  static constexpr uint32_t kWords = 16, kMostBytes = 63;

  static uint32_t bits(const uint32_t* words) {
    uint32_t sum = 0, zeros = 0;  // zeros: a bit for each word
    for (uint32_t i = 0; i < kWords; ++i) sum += words[i] == 0 ? 0 : word_bits(words[i]);
    for (uint32_t i = 0; i < kWords; ++i) zeros |= (words[i] == 0 ? 1u : 0u) << i;
    return sum + (kPrefixBits + kRunBits) * runs(zeros);
  }
  static void write(const uint32_t* words, BitWriter& out) {
    for (uint32_t i = 0; i < kWords;) {
      if (words[i] == 0) {
        const uint32_t begin = i;
        while (i < kWords && i - begin < kLongestRun && words[i] == 0) ++i;
        out.put(kZeros << kRunBits | (i - begin - 1), kPrefixBits + kRunBits);
        continue;
      }
      const FpcPrefix prefix = prefix_of(words[i]);
      out.put(prefix, kPrefixBits);
      out.put(behind_prefix(words[i++], prefix), kBitsBehind[prefix]);
    }
  }
  static bool read(BitReader& in, uint32_t* words) {
    for (uint32_t i = 0; i < kWords;) {
      const auto prefix = static_cast<FpcPrefix>(in.get(kPrefixBits));
      const auto behind = static_cast<uint32_t>(in.get(kBitsBehind[prefix]));
      if (prefix != kZeros) {
        words[i++] = word_from(prefix, behind);
        continue;
      }
      if (behind >= kWords - i) return false;
      for (const uint32_t end = i + behind + 1; i < end; ++i) words[i] = 0;
    }
    return true;
  }

 private:
  /// Returns how many runs of up to 8 the zeros of a line make.
  static uint32_t runs(uint32_t zeros) {
    const auto begins = static_cast<uint32_t>(std::popcount(zeros & ~(zeros << 1)));
    uint32_t nine = zeros & zeros >> 1;  // where nine zeros begin: at most one run is so long
    nine &= nine >> 2;
    nine &= nine >> 4;
    nine &= zeros >> 8;
    return begins + (nine != 0 ? 1 : 0);
  }
};

}  // namespace

const SchemeInfo kFpcInfo = {.name = "fpc",
                             .label = "FPC",
                             .family = "lines",
                             .group = SchemeGroup::kLiterature,
                             .summary = "frequent pattern compression of the words of 64-byte lines",
                             .source = "Alameldeen and Wood 2004",
                             .make_encoder = make_encoder<SizedLineEncoder<FpcLine>>,
                             .make_decoder = make_decoder<SizedLineDecoder<FpcLine>>,
                             .keys = kOrderKey,
                             .eight_bit_only = true};

}  // namespace tilepress
