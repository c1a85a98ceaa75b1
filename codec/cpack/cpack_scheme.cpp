// C-Pack: words of 64-byte lines matched against a dictionary of the line's earlier words (Chen et al. 2010).
//
//   CSB, payload, tables    see pixels/sized_lines.h; four lines of 16 words
//   stream of a line        for each word a code, then
//               code  word   bits behind the code
//               00    zzzz    0
//               01    xxxx   32
//               10    mmmm    4, the entry
//               1100  mmxx    4, the entry, and 16
//               1101  zzzx    8
//               1110  mmmx    4, the entry, and 8
//             A letter is a byte, the highest first: z is 0, m is the same byte of a dictionary entry, x is
//             stored.
//
// Modelling decisions. The dictionary begins each line empty. The words coded as xxxx, mmxx and mmmx enter
// it, in their order. A line has 16 words and the dictionary 16 entries, so no word ever leaves. The code
// with the fewest bits wins, then the lowest entry. A line whose stream takes 64 bytes or more is raw. Lines
// take the block's pixels row by row, two rows per line; `order=quad` takes them in traversal order.
#include <algorithm>
#include <array>

#include "pixels/sized_lines.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kLineWords = 16, kEntryBits = 4;

/// A code: its bits, and how many low bytes of the word follow.
struct CpackCode {
  uint32_t code, code_bits;
  bool match;  ///< an entry follows, which has the other bytes; else these are 0
  uint32_t stored_bits;
  constexpr uint32_t bits() const { return code_bits + (match ? kEntryBits : 0) + stored_bits; }
  constexpr bool enters() const { return stored_bits == 32 || (match && stored_bits > 0); }
};
constexpr CpackCode kZzzz = {0b00, 2, false, 0}, kXxxx = {0b01, 2, false, 32}, kMmmm = {0b10, 2, true, 0},
                    kMmxx = {0b1100, 4, true, 16}, kZzzx = {0b1101, 4, false, 8},
                    kMmmx = {0b1110, 4, true, 8};

/// What a word differs in from the entry that is most like it, and that entry.
struct Match {
  uint32_t difference = ~0u;
  uint32_t entry = 0;
};

class Dictionary16 {
 public:
  Match find(uint32_t word) const {
    Match best;
    for (uint32_t i = 0; i < count_; ++i)
      if (const uint32_t difference = entries_[i] ^ word; class_of(difference) < class_of(best.difference))
        best = {difference, i};
    return best;
  }
  void add(uint32_t word) { entries_[count_++] = word; }
  uint32_t count() const { return count_; }
  uint32_t operator[](uint32_t entry) const { return entries_[entry]; }

 private:
  /// 0, 1, 2 and 3: all bytes, the high three, the high two, or fewer are the same.
  static uint32_t class_of(uint32_t difference) {
    return (difference != 0) + (difference > 0xFF) + (difference > 0xFFFF);
  }
  std::array<uint32_t, kLineWords> entries_;
  uint32_t count_ = 0;
};

const CpackCode& code_of(uint32_t word, const Match& match) {
  if (word == 0) return kZzzz;
  if (match.difference == 0) return kMmmm;
  if (word <= 0xFF) return kZzzx;
  if (match.difference <= 0xFF) return kMmmx;
  return match.difference <= 0xFFFF ? kMmxx : kXxxx;
}

const CpackCode* read_code(BitReader& in) {
  switch (in.get(2)) {
    case 0b00:
      return &kZzzz;
    case 0b01:
      return &kXxxx;
    case 0b10:
      return &kMmmm;
    default:
      break;
  }
  switch (in.get(2)) {
    case 0b00:
      return &kMmxx;
    case 0b01:
      return &kZzzx;
    case 0b10:
      return &kMmmx;
    default:
      return nullptr;
  }
}

struct CpackLine {
  static constexpr uint32_t kWords = kLineWords, kMostBytes = 63;

  static uint32_t bits(const uint32_t* words) {
    bool low_halves = false;  // a word of two low bytes
    for (uint32_t i = 0; i < kWords; ++i) low_halves |= words[i] - 0x100 < 0xFF00;
    return low_halves ? bits_by_dictionary(words) : bits_by_words_before(words);
  }
  static void write(const uint32_t* words, BitWriter& out) {
    Dictionary16 dictionary;
    for (uint32_t i = 0; i < kWords; ++i) {
      const Match match = dictionary.find(words[i]);
      const CpackCode& code = code_of(words[i], match);
      out.put(code.code, code.code_bits);
      if (code.match) out.put(match.entry, kEntryBits);
      out.put(words[i] & low_bits(code), code.stored_bits);
      if (code.enters()) dictionary.add(words[i]);
    }
  }
  static bool read(BitReader& in, uint32_t* words) {
    Dictionary16 dictionary;
    for (uint32_t i = 0; i < kWords; ++i) {
      const CpackCode* code = read_code(in);
      if (code == nullptr) return false;
      uint32_t others = 0;
      if (code->match) {
        const auto entry = static_cast<uint32_t>(in.get(kEntryBits));
        if (entry >= dictionary.count()) return false;
        others = dictionary[entry];
      }
      words[i] = (others & ~low_bits(*code)) | static_cast<uint32_t>(in.get(code->stored_bits));
      if (code->enters()) dictionary.add(words[i]);
    }
    return true;
  }

 private:
  /// The definition.
  static uint32_t bits_by_dictionary(const uint32_t* words) {
    Dictionary16 dictionary;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < kWords; ++i) {
      const CpackCode& code = code_of(words[i], dictionary.find(words[i]));
      sum += code.bits();
      if (code.enters()) dictionary.add(words[i]);
    }
    return sum;
  }
  /// The same for a line whose words have one byte or a high half. Every earlier word with a high half is in
  /// the dictionary, or its equal is. The other words are not, and match no high half. So a comparison with
  /// all words before gives the same codes, without branches.
  static uint32_t bits_by_words_before(const uint32_t* words) {
    std::array<uint32_t, size_t{2} * kWords> line{};  // zeros, which match no high half, then the words
    std::array<uint32_t, kWords> difference;          // the least from a word before
    std::copy_n(words, kWords, line.begin() + kWords);
    difference.fill(~0u);
    for (uint32_t back = 1; back < kWords; ++back)
      for (uint32_t i = 0; i < kWords; ++i)
        difference[i] = std::min(difference[i], words[i] ^ line[kWords + i - back]);
    uint32_t sum = 0;
    for (uint32_t i = 0; i < kWords; ++i) {
      uint32_t bits = difference[i] <= 0xFFFF ? kMmxx.bits() : kXxxx.bits();
      bits = difference[i] <= 0xFF ? kMmmx.bits() : bits;
      bits = difference[i] == 0 ? kMmmm.bits() : bits;
      bits = words[i] <= 0xFF ? kZzzx.bits() : bits;
      sum += words[i] == 0 ? kZzzz.bits() : bits;
    }
    return sum;
  }
  static uint32_t low_bits(const CpackCode& code) {
    return static_cast<uint32_t>((uint64_t{1} << code.stored_bits) - 1);
  }
};

}  // namespace

const SchemeInfo kCpackInfo = {.name = "cpack",
                               .label = "C-Pack",
                               .family = "lines",
                               .group = SchemeGroup::kLiterature,
                               .summary = "words of 64-byte lines matched against the line's earlier words",
                               .source = "Chen et al. 2010",
                               .make_encoder = make_encoder<SizedLineEncoder<CpackLine>>,
                               .make_decoder = make_decoder<SizedLineDecoder<CpackLine>>,
                               .keys = kOrderKey,
                               .eight_bit_only = true};

}  // namespace tilepress
