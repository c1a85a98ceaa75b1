// HuffDCP: Huffman codes over the CCD instead of fixed-width indices (paper §Methodology; spec §5).
//
//   CSB       16 × 1 bit: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 canonical codes, fewer than 4 × pixel bits together
//                            raw         4 × pixel bits
//   tables    N slots of an rCCD entry (pixel bits + 1), then N code lengths of 6 bits (0 in invalid slots)
#include <algorithm>
#include <array>

#include "dcp/dcp_family.h"
#include "huffman.h"
#include "scheme_factory.h"

namespace tilepress {
namespace {

constexpr uint32_t kLengthBits = 6;

class HuffDcpEncoder final : public DcpFamilyEncoder {
 public:
  HuffDcpEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyEncoder(spec, format) {}

  void begin_frame(const FrameContext& frame) override {
    DcpFamilyEncoder::begin_frame(frame);
    if (!active()) return;
    huffman_lengths(ccd_->counts, lengths_);
    code_.assign(lengths_);
    if (lengths_.size() <= first_lengths_.size())
      std::copy(lengths_.begin(), lengths_.end(), first_lengths_.begin());
  }
  uint32_t csb_bits() const override { return off_ ? 0 : kSubBlocks; }
  uint64_t palette_bits() const override {
    return active() ? uint64_t{ccd_->entries} * (pixel_bits_ + 1 + kLengthBits) : 0;
  }
  void write_tables(BitWriter& out) const override {
    if (!active()) return;
    Rccd::write(*ccd_, ccd_->entries, pixel_bits_, out);
    for (uint32_t i = 0; i < ccd_->entries; ++i)
      out.put(i < ccd_->colors.size() ? code_.length(i) : 0, kLengthBits);
  }
  uint32_t measure(const BlockContext& block) const override {
    if (!active()) return raw_block_bits();
    if (block.uniform) return kSubBlocks * sub_block_bits(block, 0);
    if (const auto code_sum = sub_block_kernels().code_sum;
        code_sum != nullptr && lengths_.size() <= first_lengths_.size())
      return code_sum(block.ccd_indices, first_lengths_.data(), raw_sub_block_bits());
    uint32_t bits = 0;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) bits += sub_block_bits(block, sub);
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    BitWriter out = payload;  // a copy stays in registers
    uint32_t marks = 0;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const uint32_t bits = active() ? sub_block_bits(block, sub) : raw_sub_block_bits();
      marks <<= 1;
      if (bits == raw_sub_block_bits()) {
        write_raw_pixels(block.pixels + sub * kSubBlockPixels, kSubBlockPixels, pixel_bits_, out);
        continue;
      }
      marks |= 1;
      uint64_t codes = 0;  // those not written yet
      uint32_t length = 0;
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
        const uint32_t index = block.ccd_indices[sub * kSubBlockPixels + i];
        if (length + code_.length(index) > kMaxBitsPerCall) {
          out.put(codes, length);
          codes = length = 0;
        }
        codes = codes << code_.length(index) | code_.code(index);
        length += code_.length(index);
      }
      out.put(codes, length);
    }
    payload = out;
    if (!off_) csb.put(marks, kSubBlocks);
  }

 private:
  uint32_t sub_block_bits(const BlockContext& block, uint32_t sub) const {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
      const uint32_t index = block.ccd_indices[sub * kSubBlockPixels + i];
      if (index == kNotInCcd) return raw_sub_block_bits();
      bits += code_.length(index);
    }
    return std::min(bits, raw_sub_block_bits());
  }
  std::vector<uint8_t> lengths_;
  std::array<uint8_t, 64> first_lengths_{};  ///< the same, if they are no more
  CanonicalCode code_;
};

class HuffDcpDecoder final : public DcpFamilyDecoder {
 public:
  HuffDcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyDecoder(spec, format) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    const uint32_t slot_bits = pixel_bits_ + 1 + kLengthBits;
    code_.assign({});
    if (table_bits % slot_bits != 0) return false;
    const uint64_t slots = table_bits / slot_bits;
    if (!DcpFamilyDecoder::begin_frame(tables, slots * (pixel_bits_ + 1), csb_bits)) return false;
    std::vector<uint8_t> lengths;
    for (uint64_t i = 0; i < slots; ++i) {
      const auto length = static_cast<uint8_t>(tables.get(kLengthBits));
      if ((length != 0) != (i < rccd_.colors.size())) return false;
      if (length != 0) lengths.push_back(length);
    }
    return !tables.overran() && code_.assign(lengths);
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const uint64_t marks = off_ ? 0 : csb.get(kSubBlocks);
    if (marks == 0) {
      read_raw_block(payload, pixel_bits_, out);
      return !csb.overran() && !payload.overran();
    }
    BitReader in = payload;  // a copy stays in registers
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
    return !csb.overran() && !payload.overran();
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks; }

 private:
  struct SubBlock {
    uint32_t color[kSubBlockPixels];
    uint64_t codes;
    uint32_t length;  ///< of the codes together; 0: too many to compare
  };
  bool read_sub_block(BitReader& in, SubBlock& out) const {
    const uint64_t window = in.peek(), begin = in.position();
    uint32_t indices[kSubBlockPixels];
    if (!code_.read_four(in, indices)) return false;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i)
      out.color[i] = rccd_.colors[indices[i]];  // there are as many codes
    const uint64_t bits = in.position() - begin;
    out.length = bits <= kMaxBitsPerCall ? static_cast<uint32_t>(bits) : 0;
    out.codes = out.length == 0 ? 0 : window >> (64 - out.length);
    return true;
  }
  /// Skips the sub-blocks of the same codes that follow, which are of the same colours; returns how many. The
  /// uppermost of kAllMarks is the next one's mark.
  static uint32_t skip_alike(uint64_t marks, const SubBlock& sub_block, BitReader& stream) {
    BitReader in = stream;  // in registers
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
  static constexpr uint64_t kAllMarks = (1u << kSubBlocks) - 1;
  CanonicalCode code_;
};

}  // namespace

const SchemeInfo kHuffDcpInfo = {"huffdcp",
                                 "HuffDCP",
                                 "Huffman codes over the CCD, built from the FVC's counts",
                                 "Gubran et al., Methodology",
                                 true,
                                 false,
                                 make_encoder<HuffDcpEncoder>,
                                 make_decoder<HuffDcpDecoder>};

}  // namespace tilepress
