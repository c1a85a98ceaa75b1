// VDCP: index width chosen per sub-block (paper §Variable DCP; spec §5).
//
//   CSB       16 × ceil(log2(M+2)) bits: the width w of the sub-block's indices, all ones = raw
//   payload   per sub-block: compressed  4 × w bits of CCD index (w = 0: nothing)
//                            raw         4 × pixel bits
//   tables    N rCCD slots
#include "dcp/vdcp.h"
#include "scheme_factory.h"

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
  uint64_t palette_bits() const override {
    return active() ? uint64_t{ccd_->entries} * (pixel_bits_ + 1) : 0;
  }
  void write_tables(BitWriter& out) const override {
    if (active()) Rccd::write(*ccd_, ccd_->entries, pixel_bits_, out);
  }
  uint32_t measure(const BlockContext& block) const override {
    return active() ? vdcp_measure(block, pixel_bits_) : raw_block_bits();
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    if (off_) return write_raw_block(block.pixels, pixel_bits_, payload);
    const uint32_t width = csb_width(index_bits_);
    vdcp_encode(block, active(), index_bits_, pixel_bits_, width, payload, csb);
  }
  StoredBlock store(const BlockContext& block, std::span<uint8_t> slot,
                    std::span<uint8_t> csb) const override {
    if (off_ || !vdcp_writes_at_once(index_bits_, pixel_bits_)) return BlockEncoder::store(block, slot, csb);
    const uint32_t width = csb_width(index_bits_), half_bits = kSubBlocks / 2 * width;
    const WrittenBlock written = vdcp_write(block, active(), width, slot.data());
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

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    if (!DcpFamilyDecoder::begin_frame(tables, table_bits, csb_bits)) return false;
    reads_at_once_ =
        kernels().byte_permutes && index_bits_ <= kMaxWrittenBits && rccd_.colors.size() <= colors_.size();
    if (reads_at_once_) std::copy(rccd_.colors.begin(), rccd_.colors.end(), colors_.begin());
    return true;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const uint32_t csb_bits = csb_width(index_bits_), raw_mark = (1u << csb_bits) - 1;
    uint64_t marks[2] = {0, 0};  // of eight sub-blocks each
    for (uint64_t& half : marks)
      if (!off_) half = csb.get(8 * csb_bits);
    const uint64_t all_raw = (uint64_t{1} << 8 * csb_bits) - 1;
    if (off_ || (marks[0] == all_raw && marks[1] == all_raw)) {
      read_raw_block(payload, pixel_bits_, out);
      return !csb.overran() && !payload.overran();
    }
    if ((marks[0] == marks[1] && decode_solid(marks[0], csb_bits, payload, out)) ||
        (reads_at_once_ && decode_at_once(marks, csb_bits, payload, out)))
      return !csb.overran() && !payload.overran();
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const auto width = static_cast<uint32_t>(marks[sub / 8] >> (7 - sub % 8) * csb_bits & raw_mark);
      if (width == raw_mark)
        read_raw_sub_block(payload, sub, pixel_bits_, out);
      else if (width > index_bits_ || !vdcp_decode_sub_block(rccd_, width, sub, payload, out))
        return false;
    }
    return !csb.overran() && !payload.overran();
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks * csb_width(index_bits_); }

 private:
  /// A block that is all indices. False, and nothing is read, if it is none.
  bool decode_at_once(const uint64_t marks[2], uint32_t csb_bits, BitReader& payload, Block& out) const {
    const uint8_t* bytes = payload.at_byte(64);
    if (bytes == nullptr) return false;
    const auto known = static_cast<uint32_t>(rccd_.colors.size());
    const uint32_t bits =
        kernels().read_indices(bytes, marks, csb_bits, index_bits_, colors_.data(), known, out.pixels.data());
    if (bits == kNotAllIndices) return false;
    payload.skip(bits);
    return true;
  }
  /// Blocks of one colour are common, and quicker to fill than to look up pixel by pixel. False, and nothing
  /// is read, if this is none. `marks` are those of either half.
  bool decode_solid(uint64_t marks, uint32_t csb_bits, BitReader& payload, Block& out) const {
    const uint64_t width = marks & ((1u << csb_bits) - 1);
    if (width > index_bits_ || marks >> csb_bits != (marks & ((uint64_t{1} << 7 * csb_bits) - 1)))
      return false;
    const uint32_t at_once = 8 * width <= kMaxBitsPerCall ? 8 : 4;
    const auto bits = static_cast<uint32_t>(at_once * width);
    BitReader in = payload;
    const uint64_t indices = in.get(bits);
    for (uint32_t i = at_once; i < kBlockPixels && width != 0; i += at_once)
      if (in.get(bits) != indices) return false;
    const uint64_t index = indices & ((uint64_t{1} << width) - 1);
    const bool alike = indices >> width == (indices & ((uint64_t{1} << (at_once - 1) * width) - 1));
    if (!alike || index >= rccd_.colors.size()) return false;
    out.pixels.fill(rccd_.colors[index]);
    payload = in;
    return true;
  }

  bool reads_at_once_ = false;
  std::array<uint32_t, SlotTable::kSlots> colors_{};  ///< of the rCCD, if it reads at once
};

}  // namespace

const SchemeInfo kVdcpInfo = {"vdcp",
                              "VDCP",
                              "palette indices of a width chosen per sub-block, recorded in the CSB",
                              "Gubran et al., Variable DCP",
                              true,
                              false,
                              make_encoder<VdcpEncoder>,
                              make_decoder<VdcpDecoder>};

}  // namespace tilepress
