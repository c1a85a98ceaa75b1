// LCC codes: a prefix code for each context, learned from the symbols of the frame before.
//
//   tables    |length 4| for each symbol of each context, 7840 bits
//
// Fixed lengths are Huffman's for weights too. Those of tokens are a table in lcc_codes.cpp. The weight of a
// class of residuals is v · 2^20 / 2^min(26, f / h), both divisions rounded down: v is the number of folded
// residuals of the class (64 for the last), f is the first of them, and h is the half-life of the context,
// also in lcc_codes.cpp. In Huffman's rule, the leaves of a context have ids in the order of their symbols.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dictionary/huffman.h"
#include "lcc/lcc_symbols.h"
#include "tilepress/bit_io.h"

namespace tilepress {

/// How often each symbol was coded.
using LccCounts = std::array<uint32_t, kLccSymbols>;

/// Code lengths by symbol.
struct LccLengths {
  static constexpr uint32_t kBitsEach = 4;
  static constexpr uint64_t kTableBits = uint64_t{kLccSymbols} * kBitsEach;
  std::array<uint8_t, kLccSymbols> of{};

  /// Huffman's lengths, see dictionary/huffman.h. Each count is raised by 1 and by a 1024th of the context's
  /// sum, rounded down. So each symbol has a code, and no code is longer than 14 bits: the sum of a context
  /// is at most 1041 times its smallest weight, and a code of 15 bits needs 1597 times (the 17th Fibonacci
  /// number).
  static LccLengths learned(const LccCounts& counts);
  /// Of frames without tables: residuals fall off by half with each step, wider where neighbours differ more.
  static const LccLengths& fixed();

  uint64_t bits(const LccCounts& counts) const;
  void write(BitWriter& out) const;
  void read(BitReader& in);
};

/// The codes themselves, canonical, by context.
class LccCodes {
 public:
  /// Returns false if the lengths of a context form no prefix code.
  bool assign(const LccLengths& lengths);
  /// `number` is a symbol of the context.
  void write(uint32_t number, BitWriter& out) const;
  /// Reads a symbol of the context that begins at `first`. Returns false if there is none.
  bool read(uint32_t first, BitReader& in, uint32_t& symbol) const {
    return codes_[context_of(first)].read(in, symbol);
  }

 private:
  static uint32_t context_of(uint32_t number) {
    return number < kLccFirstClass ? number / kLccTokens
                                   : kLccTokenContexts + (number - kLccFirstClass) / kLccClasses;
  }
  std::vector<CanonicalCode> codes_;
};

}  // namespace tilepress
