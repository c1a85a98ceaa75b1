// VDCP: index width chosen per sub-block (paper §Variable DCP).
//
//   CSB       16 × ceil(log2(M+2)) bits: the width w of the sub-block's indices, all ones = raw
//   payload   per sub-block: compressed  4 × w bits of CCD index (w = 0: nothing)
//                            raw         4 × pixel bits
//   tables    N rCCD slots
#include "dcp/dcp_family.h"
#include "dcp/sub_blocks.h"
#include "registry.h"

namespace tilepress {
namespace {

/// ceil(log2(M + 2)): widths 0 … M and the raw mark.
uint32_t csb_width(uint32_t index_bits) {
  return static_cast<uint32_t>(std::bit_width(index_bits + 1));
}

class VdcpEncoder final : public DcpFamilyEncoder {
 public:
  VdcpEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyEncoder(spec, format) {}

  uint32_t csb_bits() const override { return off_ ? 0 : kSubBlocks * csb_width(index_bits_); }
  uint32_t measure(const BlockContext&) const override {
    return active() ? payload_bits(view_->widths, pixel_bits_) : raw_block_bits();
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    if (off_) return write_raw_block(block.pixels, pixel_bits_, payload);
    const SubBlocks sub_blocks = this->sub_blocks(block);
    write_widths(sub_blocks.widths, csb_width(index_bits_), csb);
    write_payload(sub_blocks, index_bits_, pixel_bits_, payload);
  }
  StoredBlock store(const BlockContext& block, std::span<uint8_t> slot,
                    std::span<uint8_t> csb) const override {
    if (off_ || !has_write_kernel(index_bits_, pixel_bits_)) return BlockEncoder::store(block, slot, csb);
    const uint32_t width = csb_width(index_bits_), half_bits = kSubBlocks / 2 * width;
    const SubBlocks from = sub_blocks(block);
    const WrittenBlock written =
        sub_block_kernels().write(from.pixels, from.indices, from.widths, width, slot.data());
    const uint64_t marks = (written.marks[0] << half_bits | written.marks[1]) << (64 - 2 * half_bits);
    const uint64_t bytes = bit_io::big_endian(marks);
    std::memcpy(csb.data(), &bytes, sizeof bytes);
    return {written.bits, written.clean_bytes};
  }
};

class VdcpDecoder final : public DcpFamilyDecoder {
 public:
  VdcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : DcpFamilyDecoder(spec, format) {}

  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    if (off_) {
      read_raw_block(payload, pixel_bits_, out);
      return !payload.overran();
    }
    const uint32_t csb_bits = csb_width(index_bits_);
    uint64_t marks[2];
    for (uint64_t& half : marks) half = csb.get(kSubBlocks / 2 * csb_bits);
    return !csb.overran() && read_sub_blocks(marks, csb_bits, payload, out);
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks * csb_width(index_bits_); }
};

}  // namespace

const SchemeInfo kVdcpInfo = {
    .name = "vdcp",
    .label = "VDCP",
    .family = "dcp",
    .group = SchemeGroup::kPaper,
    .summary = "palette indices of a width chosen per sub-block, recorded in the CSB",
    .source = "Gubran et al., Variable DCP",
    .make_encoder = make_encoder<VdcpEncoder>,
    .make_decoder = make_decoder<VdcpDecoder>,
    .keys = kDcpKeys,
    .check = check_dcp_keys,
    .has_dcp_structures = true};

}  // namespace tilepress
