// Cut snappy block: the elements of snappy's format_description.txt, one by one.
#include "cut_snappy_block.h"

#include <algorithm>

namespace tilepress {

size_t unpack_cut_block(std::span<const uint8_t> packed, std::span<uint8_t> plain) {
  enum : uint8_t { kLiteral = 0, kCopyNear = 1, kCopyFar = 2 };
  constexpr size_t kLongestInTag = 60;
  size_t in = 0, out = 0;
  while (in < packed.size()) {
    const uint8_t tag = packed[in++];
    const uint8_t kind = tag & 3;
    size_t length = static_cast<size_t>(tag >> 2) + 1;
    size_t field_bytes = kind == kCopyNear ? 1 : kind == kCopyFar ? 2 : 4;
    if (kind == kLiteral) field_bytes = length > kLongestInTag ? length - kLongestInTag : 0;
    if (packed.size() - in < field_bytes) break;
    size_t field = 0;  // the length of a long literal less one, or how far back a copy goes
    for (size_t i = 0; i < field_bytes; ++i) field |= size_t{packed[in++]} << (8 * i);
    if (kind == kLiteral) {
      if (field_bytes > 0) length = field + 1;
      const size_t present = std::min({length, packed.size() - in, plain.size() - out});
      std::copy_n(packed.begin() + static_cast<ptrdiff_t>(in), present,
                  plain.begin() + static_cast<ptrdiff_t>(out));
      in += present;
      out += present;
      if (present < length) break;
      continue;
    }
    if (kind == kCopyNear) {
      length = static_cast<size_t>(tag >> 2 & 7) + 4;
      field |= static_cast<size_t>(tag >> 5) << 8;
    }
    if (field == 0 || field > out || length > plain.size() - out) break;
    for (; length > 0; --length, ++out) plain[out] = plain[out - field];  // may overlap
  }
  return out;
}

}  // namespace tilepress
