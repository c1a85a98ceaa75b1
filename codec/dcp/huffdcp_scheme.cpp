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
#include "simd/kernels.h"

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
    if (kernels().byte_permutes && lengths_.size() <= first_lengths_.size())
      return kernels().code_sum(block.ccd_indices, first_lengths_.data(), raw_sub_block_bits());
    uint32_t bits = 0;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) bits += sub_block_bits(block, sub);
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const bool compressed = active() && sub_block_bits(block, sub) < raw_sub_block_bits();
      if (!off_) csb.put(compressed, 1);
      if (!compressed) {
        write_raw_pixels(block.pixels + sub * kSubBlockPixels, kSubBlockPixels, pixel_bits_, payload);
        continue;
      }
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
        const uint32_t index = block.ccd_indices[sub * kSubBlockPixels + i];
        payload.put(code_.code(index), code_.length(index));
      }
    }
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
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      if (off_ || csb.get(1) == 0) {
        read_raw_sub_block(payload, sub, pixel_bits_, out);
        continue;
      }
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
        uint32_t index = 0;
        if (!code_.read(payload, index) || !color_of(index, out.pixels[sub_block_pixel(sub, i)]))
          return false;
      }
    }
    return !csb.overran() && !payload.overran();
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks; }

 private:
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
