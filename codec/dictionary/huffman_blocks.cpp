// Huffman blocks: tables, codes and raw sub-blocks.
#include "dictionary/huffman_blocks.h"

#include <algorithm>

#include "pixels/raw_bits.h"

namespace tilepress {
namespace {
constexpr uint32_t kLengthBits = 6;
constexpr uint64_t kAllMarks = (1u << kSubBlocks) - 1;
}  // namespace

void HuffmanBlockWriter::build(std::span<const uint32_t> counts) {
  huffman_lengths(counts, lengths_);
  code_.assign(lengths_);
  if (lengths_.size() <= first_lengths_.size())
    std::copy(lengths_.begin(), lengths_.end(), first_lengths_.begin());
}

void HuffmanBlockWriter::write_tables(std::span<const uint32_t> colors, uint32_t slots,
                                      BitWriter& out) const {
  write_colors(colors, slots, pixel_bits_, out);
  for (uint32_t i = 0; i < slots; ++i) out.put(i < colors.size() ? code_.length(i) : 0, kLengthBits);
}

uint32_t HuffmanBlockWriter::sub_block_bits(const uint16_t* indices) const {
  uint32_t bits = 0;
  for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
    if (indices[i] == kNoColor) return raw_bits();
    bits += code_.length(indices[i]);
  }
  return std::min(bits, raw_bits());
}

uint32_t HuffmanBlockWriter::measure(const uint16_t* indices, bool uniform) const {
  if (uniform) return kSubBlocks * sub_block_bits(indices);
  if (const CodeSum code_sum = code_sum_kernel();
      code_sum != nullptr && lengths_.size() <= first_lengths_.size())
    return code_sum(indices, first_lengths_.data(), raw_bits());
  uint32_t bits = 0;
  for (uint32_t i = 0; i < kBlockPixels; i += kSubBlockPixels) bits += sub_block_bits(indices + i);
  return bits;
}

void HuffmanBlockWriter::write_codes(const uint16_t* indices, BitWriter& out) const {
  uint64_t codes = 0;  // those not written yet
  uint32_t length = 0;
  for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
    const uint32_t index = indices[i];
    if (length + code_.length(index) > kMaxBitsPerCall) {
      out.put(codes, length);
      codes = length = 0;
    }
    codes = codes << code_.length(index) | code_.code(index);
    length += code_.length(index);
  }
  out.put(codes, length);
}

uint32_t HuffmanBlockWriter::encode(const uint32_t* pixels, const uint16_t* indices,
                                    BitWriter& payload) const {
  BitWriter out = payload;  // the compiler keeps a copy in registers
  uint32_t marks = 0;
  for (uint32_t i = 0; i < kBlockPixels; i += kSubBlockPixels) {
    const bool compressed = sub_block_bits(indices + i) < raw_bits();
    marks = marks << 1 | (compressed ? 1u : 0u);
    if (compressed)
      write_codes(indices + i, out);
    else
      write_raw_pixels(pixels + i, kSubBlockPixels, pixel_bits_, out);
  }
  payload = out;
  return marks;
}

bool HuffmanBlockReader::read_tables(BitReader& tables, uint64_t table_bits) {
  const uint32_t slot_bits = pixel_bits_ + 1 + kLengthBits;
  code_.assign({});
  table_ = ColorTable{};
  if (table_bits == 0) return true;
  if (table_bits % slot_bits != 0) return false;
  const uint64_t slots = table_bits / slot_bits;
  if (!table_.read(tables, slots, pixel_bits_)) return false;
  std::vector<uint8_t> lengths;
  for (uint64_t i = 0; i < slots; ++i) {
    const auto length = static_cast<uint8_t>(tables.get(kLengthBits));
    if ((length != 0) != (i < table_.colors().size())) return false;
    if (length != 0) lengths.push_back(length);
  }
  return !tables.overran() && code_.assign(lengths);
}

bool HuffmanBlockReader::decode(uint64_t marks, BitReader& payload, Block& out) const {
  if (marks == 0) {
    read_raw_block(payload, pixel_bits_, out);
    return !payload.overran();
  }
  BitReader in = payload;  // the compiler keeps a copy in registers
  SubBlock last;
  for (uint32_t sub = 0; sub < kSubBlocks;) {
    if ((marks >> (kSubBlocks - 1 - sub) & 1) == 0) {
      read_raw_sub_block(in, sub++, pixel_bits_, out);
      continue;
    }
    if (!read_sub_block(in, last)) return false;
    const uint32_t end = sub + 1 + skip_alike(marks << (sub + 1) & kAllMarks, last, in);
    for (; sub < end; ++sub)
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) out.pixels[sub_block_pixel(sub, i)] = last.color[i];
  }
  payload = in;
  return !payload.overran();
}

bool HuffmanBlockReader::read_sub_block(BitReader& in, SubBlock& out) const {
  const uint64_t window = in.peek(), begin = in.position();
  uint32_t indices[kSubBlockPixels];
  if (!code_.read_four(in, indices)) return false;
  for (uint32_t i = 0; i < kSubBlockPixels; ++i)
    out.color[i] = table_.colors()[indices[i]];  // there are as many codes
  const uint64_t bits = in.position() - begin;
  out.length = bits <= kMaxBitsPerCall ? static_cast<uint32_t>(bits) : 0;
  out.codes = out.length == 0 ? 0 : window >> (64 - out.length);
  return true;
}

/// Skips the sub-blocks that follow with the same codes, and so the same colours. Returns how many. The top
/// bit of the 16 `marks` belongs to the next sub-block.
uint32_t HuffmanBlockReader::skip_alike(uint64_t marks, const SubBlock& sub_block, BitReader& stream) {
  BitReader in = stream;
  const uint64_t codes = sub_block.codes;
  const uint32_t length = sub_block.length;
  uint32_t count = 0;
  for (; length != 0 && marks >> (kSubBlocks - 1) != 0; marks = marks << 1 & kAllMarks, ++count) {
    if (in.peek() >> (64 - length) != codes) break;
    in.skip(length);
  }
  stream = in;
  return count;
}

}  // namespace tilepress
