// HuffDCP: Huffman codes over the CCD instead of fixed-width indices (paper §Methodology).
//
//   CSB, payload, tables    see dictionary/huffman_blocks.h; N slots
#include "dcp/dcp_family.h"
#include "dictionary/huffman_blocks.h"
#include "registry.h"

namespace tilepress {
namespace {

class HuffDcpEncoder final : public DcpFamilyEncoder {
 public:
  HuffDcpEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyEncoder(spec, format), writer_(format.pixel_bits) {}

  void begin_frame(const FrameContext& frame) override {
    DcpFamilyEncoder::begin_frame(frame);
    if (active()) writer_.build(ccd_->counts);
  }
  uint32_t csb_bits() const override { return off_ ? 0 : kSubBlocks; }
  uint64_t palette_bits() const override {
    return active() ? huffman_table_bits(ccd_->entries, pixel_bits_) : 0;
  }
  void write_tables(BitWriter& out) const override {
    if (active()) writer_.write_tables(ccd_->colors, ccd_->entries, out);
  }
  uint32_t measure(const BlockContext& block) const override {
    return active() ? writer_.measure(view_->indices, block.uniform) : raw_block_bits();
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    uint32_t marks = 0;
    if (active())
      marks = writer_.encode(block.pixels, view_->indices, payload);
    else
      write_raw_block(block.pixels, pixel_bits_, payload);
    if (!off_) csb.put(marks, kSubBlocks);
  }

 private:
  HuffmanBlockWriter writer_;
};

class HuffDcpDecoder final : public BlockDecoder {
 public:
  HuffDcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : entries_(spec.number("fvc")), reader_(format.pixel_bits) {}

  /// 0 CSB bits mark a frame that the coverage threshold switched DCP off for.
  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    off_ = csb_bits == 0;
    if (off_) return table_bits == 0;
    return csb_bits == kSubBlocks && reader_.read_tables(tables, table_bits) &&
           reader_.table().slots() <= entries_;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    return reader_.decode(off_ ? 0 : csb.get(kSubBlocks), payload, out) && !csb.overran();
  }

 private:
  const uint32_t entries_;
  HuffmanBlockReader reader_;
  bool off_ = false;
};

}  // namespace

const SchemeInfo kHuffDcpInfo = {.name = "huffdcp",
                                 .label = "HuffDCP",
                                 .family = "dcp",
                                 .group = SchemeGroup::kPaper,
                                 .summary = "Huffman codes over the CCD, built from the FVC's counts",
                                 .source = "Gubran et al., Methodology",
                                 .make_encoder = make_encoder<HuffDcpEncoder>,
                                 .make_decoder = make_decoder<HuffDcpDecoder>,
                                 .keys = kDcpKeys,
                                 .check = check_dcp_keys,
                                 .has_dcp_structures = true};

}  // namespace tilepress
