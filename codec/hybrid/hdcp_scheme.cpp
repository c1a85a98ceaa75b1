// HDCP: codes each block with VDCP or RAS, whichever takes fewer bursts (paper §Hybrid Schemes).
//
//   CSB       16 × 5 bits. VDCP block: per sub-block its width 0 … M, or 31 = raw sub-block.
//             RAS block: 16 + class in every sub-block, so that each sub-block says how to read the block.
//   payload   as VDCP or RAS
//   tables    N rCCD slots
// If the coverage threshold switches DCP off, the frame is a RAS frame: 2 CSB bits per block, no tables.
#include "dcp/dcp_family.h"
#include "dcp/sub_blocks.h"
#include "ras/ras_bits.h"
#include "ras/ras_block.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kSubBlockCsbBits = 5;
constexpr uint32_t kRawMark = 31;
constexpr uint32_t kRasMark = 16;
/// Multiplied by a mark: the mark for each sub-block of half a block.
constexpr uint64_t kEachOfHalf = 0x0842108421;

class HdcpEncoder final : public DcpFamilyEncoder {
 public:
  HdcpEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : DcpFamilyEncoder(spec, format),
        format_(format),
        classes_{SizeChoice::kThree, kBlockPixels * format.pixel_bits, model.burst_bits} {}

  void subscribe(SharedAnalyses& analyses) override {
    DcpFamilyEncoder::subscribe(analyses);
    ras_bits_ = &analyses.get<RasBits>().subscribe(false);
  }
  uint32_t csb_bits() const override { return off_ ? classes_.csb_bits() : kSubBlocks * kSubBlockCsbBits; }
  uint32_t measure(const BlockContext&) const override { return choose().bits; }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const uint32_t cls = classes_.class_of(*ras_bits_);
    if (choose().vdcp) {
      write_widths(sub_blocks(block).widths, kSubBlockCsbBits, csb);
      return write_payload(sub_blocks(block), index_bits_, pixel_bits_, payload);
    }
    if (off_)
      csb.put(cls, classes_.csb_bits());
    else
      for (uint32_t half = 0; half < 2; ++half)
        csb.put((kRasMark + cls) * kEachOfHalf, kSubBlocks / 2 * kSubBlockCsbBits);
    ras_block_write(block, cls, classes_, format_, false, payload);
  }
  void account(const BlockContext&, uint32_t payload_bits, SchemeStatistics& statistics) const override {
    ++statistics.own[choose().vdcp ? 0 : 1];
    statistics.own[2] += payload_bits == raw_block_bits();
  }

 private:
  struct Choice {
    bool vdcp;
    uint32_t bits;
  };
  Choice choose() const {
    const uint32_t ras = classes_.bits_of(classes_.class_of(*ras_bits_));
    if (off_) return {false, ras};
    const uint32_t vdcp = active() ? payload_bits(view_->widths, pixel_bits_) : raw_block_bits();
    if (bursts(vdcp) <= bursts(ras)) return {true, vdcp};
    return {false, ras};
  }
  uint32_t bursts(uint32_t bits) const { return (bits + classes_.burst_bits - 1) / classes_.burst_bits; }

  const FormatTraits format_;
  const SizeClasses classes_;
  const uint32_t* ras_bits_ = nullptr;  ///< of the block at hand
};

class HdcpDecoder final : public DcpFamilyDecoder {
 public:
  HdcpDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : DcpFamilyDecoder(spec, format),
        format_(format),
        classes_{SizeChoice::kThree, kBlockPixels * format.pixel_bits, model.burst_bits} {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    ras_only_ = csb_bits == classes_.csb_bits();
    if (!ras_only_) return DcpFamilyDecoder::begin_frame(tables, table_bits, csb_bits);
    off_ = false;
    return table_bits == 0;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    if (off_) return false;
    if (ras_only_) {
      const auto cls = static_cast<uint32_t>(csb.get(classes_.csb_bits()));
      return !csb.overran() && ras_block_read(payload, cls, classes_, format_, false, out);
    }
    uint64_t marks[2];
    for (uint64_t& half : marks) half = csb.get(kSubBlocks / 2 * kSubBlockCsbBits);
    if (csb.overran()) return false;
    const auto mark = static_cast<uint32_t>(marks[0] & kRawMark);
    if (mark < kRasMark || mark == kRawMark) return read_sub_blocks(marks, kSubBlockCsbBits, payload, out);
    return marks[0] == marks[1] && marks[0] == mark * kEachOfHalf &&
           ras_block_read(payload, mark - kRasMark, classes_, format_, false, out);
  }

 protected:
  uint32_t on_csb_bits() const override { return kSubBlocks * kSubBlockCsbBits; }

 private:
  const FormatTraits format_;
  const SizeClasses classes_;
  bool ras_only_ = false;
};

}  // namespace

/// A raw block is also a VDCP or a RAS block.
constexpr const char* kColumns[] = {"vdcp_blocks", "ras_blocks"};
constexpr const char* kAddedColumns[] = {"raw_blocks"};

const SchemeInfo kHdcpInfo = {.name = "hdcp",
                              .label = "HDCP",
                              .family = "hybrid",
                              .group = SchemeGroup::kPaper,
                              .summary = "per block the one of VDCP and RAS with fewer bursts",
                              .source = "Gubran et al., Hybrid Schemes",
                              .make_encoder = make_encoder<HdcpEncoder>,
                              .make_decoder = make_decoder<HdcpDecoder>,
                              .keys = kDcpKeys,
                              .check = check_dcp_keys,
                              .columns = kColumns,
                              .added_columns = kAddedColumns,
                              .has_dcp_structures = true};

}  // namespace tilepress
