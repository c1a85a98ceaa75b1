// DCP and ADCP: fixed-width palette indices per sub-block (paper §Baseline DCP, §Adaptive DCP; spec §5).
//
//   CSB       16 × 1 bit, in sub-block order: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 × width bits of CCD index
//                            raw         4 × pixel bits
//   tables    2^width rCCD slots (dcp: width = M = log2 N; adcp: width from Algorithm 1)
#include "dcp/algorithm1.h"
#include "dcp/dcp_family.h"
#include "scheme_factory.h"
#include "simd/kernels.h"

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
    if (active()) Rccd::write(*ccd_, 1u << width_, pixel_bits_, out);
  }
  uint32_t measure(const BlockContext& block) const override {
    if (!active()) return raw_block_bits();
    const uint32_t compressed = kernels().count_up_to(block.ccd_widths, width_);
    return kSubBlockPixels * (compressed * width_ + (kSubBlocks - compressed) * pixel_bits_);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const bool compressed = active() && fits(block, sub);
      if (!off_) csb.put(compressed, 1);
      if (!compressed) {
        write_raw_pixels(block.pixels + sub * kSubBlockPixels, kSubBlockPixels, pixel_bits_, payload);
        continue;
      }
      for (uint32_t i = 0; i < kSubBlockPixels; ++i)
        payload.put(block.ccd_indices[sub * kSubBlockPixels + i], width_);
    }
  }

 protected:
  virtual uint32_t choose_width() const { return index_bits_; }

 private:
  bool fits(const BlockContext& block, uint32_t sub) const { return block.ccd_widths[sub] <= width_; }
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

/// Serves both: the number of rCCD slots gives the width.
class DcpDecoder final : public DcpFamilyDecoder {
 public:
  DcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyDecoder(spec, format) {}

  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const uint32_t width = rccd_.slots == 0 ? 0 : static_cast<uint32_t>(std::bit_width(rccd_.slots) - 1);
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      if (off_ || csb.get(1) == 0) {
        read_raw_sub_block(payload, sub, pixel_bits_, out);
        continue;
      }
      for (uint32_t i = 0; i < kSubBlockPixels; ++i)
        if (!color_of(payload.get(width), out.pixels[sub_block_pixel(sub, i)])) return false;
    }
    return !csb.overran() && !payload.overran();
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks; }
};

}  // namespace

const SchemeInfo kDcpInfo = {"dcp",
                             "DCP",
                             "palette indices of log2(FVC size) bits per pixel, CCD of the frame before",
                             "Gubran et al., Baseline DCP",
                             true,
                             false,
                             make_encoder<DcpEncoder>,
                             make_decoder<DcpDecoder>};
const SchemeInfo kAdcpInfo = {"adcp",
                              "ADCP",
                              "DCP with the CCD cut to the size that Algorithm 1 predicts best",
                              "Gubran et al., Adaptive DCP",
                              true,
                              false,
                              make_encoder<AdcpEncoder>,
                              make_decoder<DcpDecoder>};

}  // namespace tilepress
