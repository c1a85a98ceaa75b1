// DCP family decoder base: reads the rCCD and blocks of indices into it.
#include "dcp/dcp_family.h"

#include <algorithm>
#include <cstring>

#include "dcp/sub_blocks.h"

namespace tilepress {

bool DcpFamilyDecoder::begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) {
  rccd_ = ColorTable{};
  reads_at_once_ = false;
  off_ = csb_bits == 0;
  if (off_) return table_bits == 0;
  if (csb_bits != on_csb_bits()) return false;
  if (table_bits == 0) return true;  // no CCD yet: every sub-block is marked raw
  if (table_bits % (pixel_bits_ + 1) != 0) return false;
  if (!rccd_.read(tables, table_bits / (pixel_bits_ + 1), pixel_bits_)) return false;
  if (rccd_.slots() > 1u << index_bits_) return false;
  reads_at_once_ = sub_block_kernels().read != nullptr && index_bits_ <= kMaxKernelWidth &&
                   rccd_.colors().size() <= colors_.size();
  if (reads_at_once_) std::copy(rccd_.colors().begin(), rccd_.colors().end(), colors_.begin());
  return true;
}

bool DcpFamilyDecoder::read_sub_blocks(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload,
                                       Block& out) const {
  const uint64_t all_raw = (uint64_t{1} << 8 * mark_bits) - 1;
  if (marks[0] == all_raw && marks[1] == all_raw) {
    read_raw_block(payload, pixel_bits_, out);
    return !payload.overran();
  }
  if ((marks[0] == marks[1] && read_solid(marks[0], mark_bits, payload, out)) ||
      (reads_at_once_ && read_at_once(marks, mark_bits, payload, out)))
    return !payload.overran();
  const uint32_t raw_mark = (1u << mark_bits) - 1;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const auto width = static_cast<uint32_t>(marks[sub / 8] >> (7 - sub % 8) * mark_bits & raw_mark);
    if (width == raw_mark)
      read_raw_sub_block(payload, sub, pixel_bits_, out);
    else if (width > index_bits_ || !read_indices(width, sub, payload, out))
      return false;
  }
  return !payload.overran();
}

/// Reads a block that has only indices. Returns false without reading anything for any other block.
bool DcpFamilyDecoder::read_at_once(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload,
                                    Block& out) const {
  const uint8_t* bytes = payload.at_byte(64);
  if (bytes == nullptr) return false;
  const auto known = static_cast<uint32_t>(rccd_.colors().size());
  const uint32_t bits = sub_block_kernels().read(bytes, marks, mark_bits, index_bits_, colors_.data(), known,
                                                 out.pixels.data());
  if (bits == kNotAllIndices) return false;
  payload.skip(bits);
  return true;
}

/// Reads a block of one colour. Such blocks are common, and a fill is faster than 64 look-ups. Returns false
/// without reading anything for any other block. `marks` are the marks of each half.
bool DcpFamilyDecoder::read_solid(uint64_t marks, uint32_t mark_bits, BitReader& payload, Block& out) const {
  const uint64_t width = marks & ((1u << mark_bits) - 1);
  if (width > index_bits_ || marks >> mark_bits != (marks & ((uint64_t{1} << 7 * mark_bits) - 1)))
    return false;
  // Eight indices take `width` bytes, and the block repeats these eight times.
  const uint8_t* bytes = payload.at_byte(8 * width);
  if (bytes == nullptr || std::memcmp(bytes, bytes + width, 7 * width) != 0) return false;
  const auto four_bits = static_cast<uint32_t>(4 * width);
  BitReader in = payload;
  const uint64_t four = in.get(four_bits), index = four & ((uint64_t{1} << width) - 1);
  const bool alike = four >> width == (four & ((uint64_t{1} << 3 * width) - 1)) && in.get(four_bits) == four;
  if (!alike || index >= rccd_.colors().size()) return false;
  out.pixels.fill(rccd_.colors()[index]);
  payload.skip(kBlockPixels * width);
  return true;
}

/// Reads a sub-block of indices of `width` ≤ 10 bits. Returns false if an index is beyond the rCCD.
bool DcpFamilyDecoder::read_indices(uint32_t width, uint32_t sub, BitReader& payload, Block& out) const {
  const uint64_t indices = payload.get(kSubBlockPixels * width);
  const uint64_t mask = (uint64_t{1} << width) - 1;
  for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
    const uint64_t index = indices >> (3 - i) * width & mask;
    if (index >= rccd_.colors().size()) return false;
    out.pixels[sub_block_pixel(sub, i)] = rccd_.colors()[index];
  }
  return true;
}

}  // namespace tilepress
