// What the schemes of the DCP family share: the CCD in force, dynamic enabling, the rCCD.
#pragma once

#include <array>
#include <bit>

#include "dcp/ccd.h"
#include "dcp/sub_blocks.h"
#include "pixels/raw_bits.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Encoder base: knows the CCD of the frame and whether the coverage threshold switches the scheme off
/// (paper §Dynamically Enabling DCP).
class DcpFamilyEncoder : public BlockEncoder {
 public:
  DcpFamilyEncoder(const SchemeSpec& spec, const FormatTraits& format)
      : coverage_threshold_(spec.coverage),
        index_bits_(static_cast<uint32_t>(std::bit_width(spec.fvc.entries) - 1)),
        pixel_bits_(format.pixel_bits) {}
  SchemeNeeds needs() const override { return {.ccd = true}; }
  void begin_frame(const FrameContext& frame) override {
    ccd_ = frame.ccd;
    off_ = ccd_ != nullptr && ccd_->coverage < coverage_threshold_;
  }

 protected:
  /// True if sub-blocks may be looked up: there is a CCD and the scheme is on.
  bool active() const { return ccd_ != nullptr && !off_; }
  SubBlocks sub_blocks(const BlockContext& block) const {
    return {block.pixels, block.ccd_indices, active() ? block.ccd_widths : kAllRawWidths.data()};
  }
  uint32_t raw_sub_block_bits() const { return kSubBlockPixels * pixel_bits_; }
  uint32_t raw_block_bits() const { return kBlockPixels * pixel_bits_; }

  const double coverage_threshold_;
  const uint32_t index_bits_;  ///< M = log2 N
  const uint32_t pixel_bits_;
  const Ccd* ccd_ = nullptr;
  bool off_ = false;
};

/// Decoder base: an rCCD of (pixel bits + 1) bits a slot; csb_bits = 0 marks a frame the scheme was off for.
class DcpFamilyDecoder : public BlockDecoder {
 public:
  DcpFamilyDecoder(const SchemeSpec& spec, const FormatTraits& format)
      : index_bits_(static_cast<uint32_t>(std::bit_width(spec.fvc.entries) - 1)),
        pixel_bits_(format.pixel_bits) {}
  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override;

 protected:
  /// CSB bits a block has when the scheme is on.
  virtual uint32_t on_csb_bits() const = 0;
  /// Reads a block. `marks`, of eight sub-blocks each and `mark_bits` ≤ 7 bits a mark, have the width of its
  /// indices for each, all ones for a raw one. False: a width over M, an index beyond the rCCD, too few bits.
  bool read_sub_blocks(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload, Block& out) const;
  const uint32_t index_bits_;
  const uint32_t pixel_bits_;
  Rccd rccd_;
  bool off_ = false;

 private:
  bool read_solid(uint64_t marks, uint32_t mark_bits, BitReader& payload, Block& out) const;
  bool read_at_once(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload, Block& out) const;
  bool read_indices(uint32_t width, uint32_t sub, BitReader& payload, Block& out) const;
  bool reads_at_once_ = false;
  std::array<uint32_t, SlotTable::kSlots> colors_{};  ///< of the rCCD, if it reads at once
};

}  // namespace tilepress
