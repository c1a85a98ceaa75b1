#include "lcc/lcc_codes.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace tilepress {
namespace {

/// Calls visit(first, count) for the symbols of each context.
template <class Visit>
void for_each_context(const Visit& visit) {
  for (uint32_t at = 0; at < kLccFirstClass; at += kLccTokens) visit(at, kLccTokens);
  for (uint32_t at = kLccFirstClass; at < kLccSymbols; at += kLccClasses) visit(at, kLccClasses);
}

/// Puts Huffman's lengths for these weights at `at`.
void set_lengths(std::span<const uint32_t> weights, LccLengths& lengths, uint32_t at) {
  const std::vector<uint8_t> found = huffman_lengths(weights);
  std::copy(found.begin(), found.end(), lengths.of.begin() + at);
}

/// Weights of tokens without tables, by kind of shape and residuals beside. Kinds: left = above; above left
/// equals one of them; no two are equal.
constexpr uint32_t kFixedTokens[3][3][kLccTokens] = {
    {{900, 60, 10, 10, 10, 20, 10, 1}, {300, 80, 20, 30, 20, 40, 20, 1}, {120, 60, 20, 30, 20, 120, 60, 4}},
    {{60, 100, 10, 20, 20, 20, 10, 1}, {50, 60, 10, 20, 20, 60, 40, 1}, {30, 30, 10, 20, 10, 120, 100, 4}},
    {{60, 60, 10, 20, 20, 30, 60, 1}, {40, 40, 10, 20, 20, 50, 160, 2}, {8, 8, 4, 6, 6, 60, 400, 8}},
};
constexpr uint32_t fixed_kind(uint32_t shape) {
  return shape <= 1 || shape == 4 ? 0 : shape <= 3 ? 1 : 2;
}

/// Folded residuals until the weight halves. Luma and alpha: by class of gradient. Colours: the mean, rounded
/// up, of a number by half the class and a number by the bit width of the residual before.
constexpr uint32_t kFixedByGradient[8] = {1, 1, 2, 3, 4, 7, 12, 24};
constexpr uint32_t kFixedByHalfGradient[5] = {1, 1, 2, 4, 10};
constexpr uint32_t kFixedBySize[8] = {1, 1, 1, 2, 2, 3, 6, 12};
uint32_t fixed_half_life(uint32_t context) {
  if (context < 24) return kFixedByGradient[context % 8];
  const uint32_t half_gradient = (context - 24) % 40 / 8, size = context % 8;
  return (kFixedByHalfGradient[half_gradient] + kFixedBySize[size] + 1) / 2;
}

LccLengths make_fixed() {
  LccLengths lengths;
  for (uint32_t context = 0; context < kLccTokenContexts; ++context)
    set_lengths(kFixedTokens[fixed_kind(context / 3)][context % 3], lengths, context * kLccTokens);
  for (uint32_t context = 0; context < kLccResidualContexts; ++context) {
    std::array<uint32_t, kLccClasses> weights{};
    for (uint32_t cls = 0; cls < kLccClasses; ++cls) {
      const uint32_t first = lcc_folded(cls, 0), values = 1u << lcc_bits_after(static_cast<uint8_t>(cls));
      weights[cls] = values << 20 >> std::min(26u, first / fixed_half_life(context));
    }
    set_lengths(weights, lengths, kLccFirstClass + context * kLccClasses);
  }
  return lengths;
}

}  // namespace

LccLengths LccLengths::learned(const LccCounts& counts) {
  LccLengths lengths;
  for_each_context([&](uint32_t at, uint32_t size) {
    std::array<uint32_t, kLccClasses> weights{};
    const uint64_t sum = std::accumulate(&counts[at], &counts[at] + size, uint64_t{0});
    for (uint32_t i = 0; i < size; ++i) weights[i] = counts[at + i] + static_cast<uint32_t>(sum >> 10) + 1;
    set_lengths({weights.data(), size}, lengths, at);
  });
  return lengths;
}

const LccLengths& LccLengths::fixed() {
  static const LccLengths lengths = make_fixed();
  return lengths;
}

uint64_t LccLengths::bits(const LccCounts& counts) const {
  uint64_t sum = 0;
  for (uint32_t i = 0; i < kLccSymbols; ++i) sum += uint64_t{counts[i]} * of[i];
  return sum;
}

void LccLengths::write(BitWriter& out) const {
  for (const uint8_t length : of) out.put(length, kBitsEach);
}

void LccLengths::read(BitReader& in) {
  for (uint8_t& length : of) length = static_cast<uint8_t>(in.get(kBitsEach));
}

bool LccCodes::assign(const LccLengths& lengths) {
  codes_.resize(kLccContexts);
  bool valid = true;
  for_each_context([&](uint32_t at, uint32_t size) {
    const std::span<const uint8_t> own(&lengths.of[at], size);
    valid = valid && std::find(own.begin(), own.end(), 0) == own.end() && codes_[context_of(at)].assign(own);
  });
  return valid;
}

void LccCodes::write(uint32_t number, BitWriter& out) const {
  const uint32_t context = context_of(number);
  const uint32_t symbol =
      number < kLccFirstClass ? number % kLccTokens : (number - kLccFirstClass) % kLccClasses;
  out.put(codes_[context].code(symbol), codes_[context].length(symbol));
}

}  // namespace tilepress
