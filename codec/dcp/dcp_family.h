// DCP family: the CCD in force, dynamic enabling and the rCCD, which its schemes share.
#pragma once

#include <array>
#include <bit>

#include "dcp/ccd_view.h"
#include "dcp/sub_blocks.h"
#include "dictionary/color_table.h"
#include "pixels/raw_bits.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Encoder base: has the CCD of the frame, and switches the scheme off below the coverage threshold (paper
/// §Dynamically Enabling DCP).
class DcpFamilyEncoder : public BlockEncoder {
 public:
  DcpFamilyEncoder(const SchemeSpec& spec, const FormatTraits& format)
      : fvc_(fvc_config(spec)),
        coverage_threshold_(spec.share("coverage")),
        index_bits_(static_cast<uint32_t>(std::bit_width(fvc_.entries) - 1)),
        pixel_bits_(format.pixel_bits) {}
  void subscribe(SharedAnalyses& analyses) override { view_ = &analyses.provided<CcdSource>().view_of(fvc_); }
  void begin_frame(const FrameContext&) override {
    ccd_ = view_->ccd;
    off_ = ccd_ != nullptr && ccd_->coverage < coverage_threshold_;
  }
  std::optional<FvcFigures> fvc_figures() const override { return view_->collected; }
  /// The whole CCD as an rCCD, unless a scheme overrides both.
  uint64_t palette_bits() const override {
    return active() ? uint64_t{ccd_->entries} * (pixel_bits_ + 1) : 0;
  }
  void write_tables(BitWriter& out) const override {
    if (active()) write_colors(ccd_->colors, ccd_->entries, pixel_bits_, out);
  }

 protected:
  /// True if the frame has a CCD and the scheme is on.
  bool active() const { return ccd_ != nullptr && !off_; }
  SubBlocks sub_blocks(const BlockContext& block) const {
    return {block.pixels, view_->indices, active() ? view_->widths : kAllRawWidths.data()};
  }
  uint32_t raw_sub_block_bits() const { return kSubBlockPixels * pixel_bits_; }
  uint32_t raw_block_bits() const { return kBlockPixels * pixel_bits_; }

  const FvcConfig fvc_;
  const double coverage_threshold_;
  const uint32_t index_bits_;  ///< M = log2 N
  const uint32_t pixel_bits_;
  const CcdView* view_ = nullptr;
  const Ccd* ccd_ = nullptr;  ///< in force for the frame; null while there is none
  bool off_ = false;
};

/// Decoder base. 0 CSB bits mark a frame that the scheme was off for.
class DcpFamilyDecoder : public BlockDecoder {
 public:
  DcpFamilyDecoder(const SchemeSpec& spec, const FormatTraits& format)
      : index_bits_(static_cast<uint32_t>(std::bit_width(spec.number("fvc")) - 1)),
        pixel_bits_(format.pixel_bits) {}
  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override;

 protected:
  /// Returns the CSB bits of a block while the scheme is on.
  virtual uint32_t on_csb_bits() const = 0;
  /// Reads a block. `marks` has the index widths of eight sub-blocks per word, `mark_bits` ≤ 7 bits each, all
  /// ones for a raw sub-block. Returns false for a width over M, an index beyond the rCCD, or missing bits.
  bool read_sub_blocks(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload, Block& out) const;
  const uint32_t index_bits_;
  const uint32_t pixel_bits_;
  ColorTable rccd_;
  bool off_ = false;

 private:
  bool read_solid(uint64_t marks, uint32_t mark_bits, BitReader& payload, Block& out) const;
  bool read_at_once(const uint64_t marks[2], uint32_t mark_bits, BitReader& payload, Block& out) const;
  bool read_indices(uint32_t width, uint32_t sub, BitReader& payload, Block& out) const;
  bool reads_at_once_ = false;
  std::array<uint32_t, SlotTable::kSlots> colors_{};  ///< of the rCCD, for the read kernel
};

}  // namespace tilepress
