// Intel11 unit: bases, slots, and the prediction across channels.
#include "intel/intel11_unit.h"

#include "cpu/bit_count.h"
#include "intel/pixel_pair.h"

namespace tilepress {
namespace {

constexpr uint32_t kWidestChannel = 8;
constexpr uint32_t kBlockOfLine = 4;  ///< pixels of a 2×2 block
constexpr uint32_t kPairBlocks = 8;
constexpr uint32_t kLowSlotBits = 14;  ///< of an extended slot, ahead of its high bits
/// The word's channels in the order of the header.
constexpr uint32_t kPlainOrder[] = {0, 1, 2, 3}, kInterOrder[] = {2, 0, 1, 3};

constexpr uint32_t byte_of(uint32_t word, uint32_t c) {
  return word >> 8 * c & 0xFF;
}

/// Returns what is predicted for R and G of a pixel.
constexpr uint32_t predicted_r(uint32_t pixel) {
  return byte_of(pixel, 2);
}
constexpr uint32_t predicted_g(uint32_t pixel) {
  return (byte_of(pixel, 2) + byte_of(pixel, 0)) / 2;
}

/// Returns the width of A: what the other widths leave of a slot.
uint32_t left_for_alpha(const Intel11Bases& bases, uint32_t slot_bits) {
  return std::min(slot_bits - bases.color_bits(), kWidestChannel);
}

uint32_t to_slot(uint32_t pixel, const Intel11Bases& bases) {
  uint32_t slot = 0, at = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t c = bases.inter ? kInterOrder[i] : kPlainOrder[i];
    uint32_t value = byte_of(pixel, c) - bases.base[i];
    if (bases.inter && c == 0) value -= predicted_r(pixel);
    if (bases.inter && c == 1) value -= predicted_g(pixel);
    slot |= (value & 0xFF) << at;
    at += bases.width[i];
  }
  return slot;
}

/// `bases` has the width of A that left_for_alpha() returns.
uint32_t from_slot(uint32_t slot, const Intel11Bases& bases) {
  uint32_t pixel = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t c = bases.inter ? kInterOrder[i] : kPlainOrder[i];
    uint32_t value = (slot & ((1u << bases.width[i]) - 1)) + bases.base[i];
    if (bases.inter && c == 0) value += predicted_r(pixel);
    if (bases.inter && c == 1) value += predicted_g(pixel);
    pixel |= (value & 0xFF) << 8 * c;
    slot >>= bases.width[i];
  }
  return pixel;
}

/// Returns the position in the pair of pixel `i` of the unit.
uint32_t unit_position(const Intel11Layout& layout, uint32_t i) {
  return quad_position(layout.first_line + i / kPairLinePixels, i % kPairLinePixels);
}

/// Calls visit(pixel, count) for each slot of an extended pair: `count` pixels from the unit's pixel `pixel`
/// on have its colour.
template <typename Visit>
void for_each_extended_slot(uint32_t extension, const Visit& visit) {
  for (uint32_t block = 0; block < kPairBlocks; ++block) {
    const bool uniform = (extension >> block & 1) != 0;
    for (uint32_t i = 0; i < (uniform ? 1 : kBlockOfLine); ++i)
      visit(block * kBlockOfLine + i, uniform ? kBlockOfLine : 1);
  }
}

void write_extended_slots(const uint32_t* pair, const Intel11Bases& bases, uint32_t extension,
                          LowFirstBits& bits) {
  const auto put_part = [&](uint32_t shift, uint32_t count) {
    for_each_extended_slot(extension, [&](uint32_t pixel, uint32_t) {
      const uint32_t slot = to_slot(pair[unit_position(kIntel11Pair64, pixel)], bases);
      bits.put(slot >> shift & ((1u << count) - 1), count);
    });
  };
  put_part(0, kLowSlotBits);
  put_part(kLowSlotBits, kExtendedSlotBits - kLowSlotBits);
}

void read_extended_slots(LowFirstBits& bits, const Intel11Bases& bases, uint32_t extension, uint32_t* pair) {
  std::array<uint32_t, kPairPixels> slots{};
  for_each_extended_slot(extension, [&](uint32_t pixel, uint32_t) { slots[pixel] = bits.get(kLowSlotBits); });
  for_each_extended_slot(extension, [&](uint32_t pixel, uint32_t count) {
    slots[pixel] |= bits.get(kExtendedSlotBits - kLowSlotBits) << kLowSlotBits;
    for (uint32_t i = pixel; i < pixel + count; ++i)
      pair[unit_position(kIntel11Pair64, i)] = from_slot(slots[pixel], bases);
  });
}

}  // namespace

Intel11Ranges united(const Intel11Ranges& a, const Intel11Ranges& b) {
  return {united(a.plain, b.plain), united(a.predicted, b.predicted)};
}

Intel11Ranges intel11_ranges(const uint32_t* pair, uint32_t line) {
  const uint32_t* upper = pair + quad_position(line, 0);
  const uint32_t* lower = pair + quad_position(line, kPairLinePixels / 2);
  std::array<uint32_t, kPairLinePixels> differences;
  const auto predict = [&](const uint32_t* pixels, uint32_t* to) {
    for (uint32_t i = 0; i < kPairLinePixels / 2; ++i) {
      const uint32_t pixel = pixels[i];
      const uint32_t r = (byte_of(pixel, 0) - predicted_r(pixel)) & 0xFF;
      const uint32_t g = (byte_of(pixel, 1) - predicted_g(pixel)) & 0xFF;
      to[i] = (r | g << 8 | r << 16 | g << 24) ^ 0x80800000;
    }
  };
  predict(upper, differences.data());
  predict(lower, differences.data() + kPairLinePixels / 2);
  return {byte_ranges(upper, lower), byte_ranges(differences.data(), differences.data() + 8)};
}

Intel11Bases plain_bases(const Intel11Ranges& ranges) {
  Intel11Bases bases;
  for (uint32_t c = 0; c < 4; ++c) {
    bases.base[c] = ranges.plain.low[c];
    bases.width[c] = static_cast<uint8_t>(ranges.plain.width(c));
  }
  return bases;
}

Intel11Bases inter_bases(const Intel11Ranges& ranges) {
  const Intel11Bases plain = plain_bases(ranges);
  Intel11Bases bases;
  bases.inter = true;
  bases.base = {plain.base[2], 0, 0, plain.base[3]};
  bases.width = {plain.width[2], 0, 0, plain.width[3]};
  for (uint32_t c = 0; c < 2; ++c) {
    const bool turned = ranges.predicted.span(c + 2) < ranges.predicted.span(c);
    const uint32_t window = turned ? c + 2 : c;
    bases.base[c + 1] = static_cast<uint8_t>(ranges.predicted.low[window] ^ (turned ? 0x80 : 0));
    bases.width[c + 1] = static_cast<uint8_t>(ranges.predicted.width(window));
  }
  return bases;
}

uint32_t intel11_extension(const uint32_t* pair) {
  uint32_t flags = 0, count = 0;
  for (uint32_t block = 0; block < kPairBlocks && count < kUniformBlocks; ++block) {
    const uint32_t* pixels = pair + unit_position(kIntel11Pair64, block * kBlockOfLine);
    if (pixels[0] != pixels[1] || pixels[0] != pixels[2] || pixels[0] != pixels[3]) continue;
    flags |= 1u << block;
    ++count;
  }
  return count == kUniformBlocks ? flags : 0;
}

void intel11_write(const uint32_t* pair, const Intel11Layout& layout, const Intel11Bases& bases,
                   uint32_t extension, BitWriter& out) {
  LowFirstBits bits;
  bits.put(bases.inter, 1);
  bits.put(extension, 8);
  for (uint32_t i = 0; i < 3; ++i) bits.put(bases.width[i], 4);
  for (uint32_t i = 0; i < 4; ++i) bits.put(bases.base[i], 8);
  if (extension != 0) {
    write_extended_slots(pair, bases, extension, bits);
  } else {
    for (uint32_t i = 0; i < layout.lines * kPairLinePixels; ++i)
      bits.put(to_slot(pair[unit_position(layout, i)], bases), layout.slot_bits);
  }
  bits.write(out, layout.bytes);
}

bool intel11_read(BitReader& in, const Intel11Layout& layout, uint32_t* pair) {
  LowFirstBits bits = LowFirstBits::read(in, layout.bytes);
  Intel11Bases bases;
  bases.inter = bits.get(1) != 0;
  const uint32_t extension = bits.get(8);
  for (uint32_t i = 0; i < 3; ++i) bases.width[i] = static_cast<uint8_t>(bits.get(4));
  for (uint32_t i = 0; i < 4; ++i) bases.base[i] = static_cast<uint8_t>(bits.get(8));
  const uint32_t slot_bits = extension != 0 ? kExtendedSlotBits : layout.slot_bits;
  if (extension != 0 && (layout.bytes != kIntel11Pair64.bytes || bit_count(extension) != kUniformBlocks))
    return false;
  for (uint32_t i = 0; i < 3; ++i)
    if (bases.width[i] > kWidestChannel) return false;
  if (bases.color_bits() > slot_bits) return false;
  bases.width[3] = static_cast<uint8_t>(left_for_alpha(bases, slot_bits));
  if (extension != 0) {
    read_extended_slots(bits, bases, extension, pair);
  } else {
    for (uint32_t i = 0; i < layout.lines * kPairLinePixels; ++i)
      pair[unit_position(layout, i)] = from_slot(bits.get(slot_bits), bases);
  }
  return true;
}

}  // namespace tilepress
