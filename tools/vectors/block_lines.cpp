// Block lines: hexadecimal numbers as $readmemh takes them.
#include "vectors/block_lines.h"

namespace tilepress {

void append_hex(uint64_t value, uint32_t digits, std::string& out) {
  for (uint32_t digit = digits; digit-- > 0;) out += "0123456789abcdef"[value >> 4 * digit & 15];
}

void append_bits_line(BitReader& in, uint64_t bits, std::string& out) {
  const auto odd = static_cast<uint32_t>(bits % 4);
  if (odd != 0) append_hex(in.get(odd), 1, out);
  for (uint64_t digit = 0; digit < bits / 4; ++digit) append_hex(in.get(4), 1, out);
  out += '\n';
}

std::string ccd_lines(std::span<const uint32_t> colors, uint32_t entries, uint32_t pixel_bits) {
  std::string out;
  for (uint32_t i = 0; i < entries; ++i) {
    const bool valid = i < colors.size();
    append_hex(valid, 1, out);
    append_hex(valid ? colors[i] : 0, pixel_bits / 4, out);
    out += '\n';
  }
  return out;
}

std::string fvc_lines(const FvcState& state, uint32_t pixel_bits) {
  std::string out;
  for (const FvcSlot& slot : state.slots) {
    append_hex(slot.count != 0, 1, out);
    append_hex(slot.color, pixel_bits / 4, out);
    append_hex(slot.count, kCountBits / 4, out);
    out += '\n';
  }
  return out;
}

std::string fvc_last_lines(const FvcState& state) {
  std::string out;
  for (const FvcSlot& slot : state.slots) {
    append_hex(slot.last, kCountBits / 4, out);
    out += '\n';
  }
  return out;
}

}  // namespace tilepress
