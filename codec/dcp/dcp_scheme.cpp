// DCP and ADCP: fixed-width palette indices per sub-block (paper §Baseline DCP, §Adaptive DCP).
//
//   CSB       16 × 1 bit, in sub-block order: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 × width bits of CCD index
//                            raw         4 × pixel bits
//   tables    2^width rCCD slots (dcp: width = M = log2 N; adcp: width from Algorithm 1)
#include <array>
#include <cstring>

#include "dcp/dcp_family.h"
#include "dcp/sub_blocks.h"
#include "registry.h"
#include "tilepress/algorithm1.h"

namespace tilepress {
namespace {

class DcpEncoder : public DcpFamilyEncoder {
 public:
  DcpEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyEncoder(spec, format) {}

  void begin_frame(const FrameContext& frame) override {
    DcpFamilyEncoder::begin_frame(frame);
    width_ = choose_width();
  }
  uint32_t csb_bits() const override { return off_ ? 0 : kSubBlocks; }
  uint64_t palette_bits() const override {
    return active() ? (uint64_t{1} << width_) * (pixel_bits_ + 1) : 0;
  }
  void write_tables(BitWriter& out) const override {
    if (active()) write_colors(ccd_->colors, 1u << width_, pixel_bits_, out);
  }
  uint32_t measure(const BlockContext&) const override {
    if (!active()) return raw_block_bits();
    const uint32_t compressed = count_up_to(view_->widths, width_);
    return kSubBlockPixels * (compressed * width_ + (kSubBlocks - compressed) * pixel_bits_);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    uint8_t widths[kSubBlocks];
    const uint32_t marks = choose_widths(block, widths);
    if (!off_) csb.put(marks, kSubBlocks);
    write_payload({block.pixels, view_->indices, widths}, width_, pixel_bits_, payload);
  }
  StoredBlock store(const BlockContext& block, std::span<uint8_t> slot,
                    std::span<uint8_t> csb) const override {
    if (off_ || !has_write_kernel(width_, pixel_bits_)) return BlockEncoder::store(block, slot, csb);
    uint8_t widths[kSubBlocks];
    const uint64_t marks = bit_io::big_endian(uint64_t{choose_widths(block, widths)} << (64 - kSubBlocks));
    std::memcpy(csb.data(), &marks, sizeof marks);
    const WrittenBlock written =
        sub_block_kernels().write(block.pixels, view_->indices, widths, kMaxKernelWidth, slot.data());
    return {written.bits, written.clean_bytes};
  }

 protected:
  virtual uint32_t choose_width() const { return index_bits_; }

 private:
  /// Fills the widths of the sub-blocks: the frame's width, or kRawWidth. Returns the CSB bits.
  uint32_t choose_widths(const BlockContext& block, uint8_t* widths) const {
    uint32_t marks = 0;
    const uint8_t* needed = sub_blocks(block).widths;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const bool compressed = needed[sub] <= width_;
      widths[sub] = compressed ? static_cast<uint8_t>(width_) : kRawWidth;
      marks = marks << 1 | (compressed ? 1u : 0u);
    }
    return marks;
  }
  uint32_t width_ = 0;
};

class AdcpEncoder final : public DcpEncoder {
 public:
  using DcpEncoder::DcpEncoder;

 protected:
  uint32_t choose_width() const override {
    return ccd_ == nullptr ? 0 : optimal_width(ccd_->counts, ccd_->samples, index_bits_, pixel_bits_);
  }
};

/// Serves both schemes: the number of rCCD slots gives the width.
class DcpDecoder final : public DcpFamilyDecoder {
 public:
  DcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyDecoder(spec, format) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    if (!DcpFamilyDecoder::begin_frame(tables, table_bits, csb_bits)) return false;
    const uint32_t width = rccd_.slots() == 0 ? 0 : rccd_.index_bits();
    for (uint32_t bits = 0; bits < marks_.size(); ++bits) {
      marks_[bits] = 0;
      for (uint32_t bit = 0x80; bit != 0; bit >>= 1)
        marks_[bits] = marks_[bits] << kMarkBits | ((bits & bit) != 0 ? width : kRawMark);
    }
    return true;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const uint64_t bits = off_ ? 0 : csb.get(kSubBlocks);
    const uint64_t marks[2] = {marks_[bits >> 8], marks_[bits & 0xFF]};
    return !csb.overran() && read_sub_blocks(marks, kMarkBits, payload, out);
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks; }

 private:
  static constexpr uint32_t kMarkBits = 4, kRawMark = 15;
  std::array<uint64_t, 256> marks_{};  ///< of read_sub_blocks, by the CSB bits of eight sub-blocks
};

}  // namespace

const SchemeInfo kDcpInfo = {
    .name = "dcp",
    .label = "DCP",
    .family = "dcp",
    .group = SchemeGroup::kPaper,
    .summary = "palette indices of log2(FVC size) bits per pixel, CCD of the frame before",
    .source = "Gubran et al., Baseline DCP",
    .make_encoder = make_encoder<DcpEncoder>,
    .make_decoder = make_decoder<DcpDecoder>,
    .keys = kDcpKeys,
    .check = check_dcp_keys,
    .has_dcp_structures = true};
const SchemeInfo kAdcpInfo = {.name = "adcp",
                              .label = "ADCP",
                              .family = "dcp",
                              .group = SchemeGroup::kPaper,
                              .summary = "DCP with the CCD cut to the size that Algorithm 1 predicts best",
                              .source = "Gubran et al., Adaptive DCP",
                              .make_encoder = make_encoder<AdcpEncoder>,
                              .make_decoder = make_decoder<DcpDecoder>,
                              .keys = kDcpKeys,
                              .check = check_dcp_keys,
                              .has_dcp_structures = true};

}  // namespace tilepress
