// LCC model: what the encoders of one FVC configuration share: the tables in force, the symbols of the block
// at hand, and the counts that the next frame's tables come from.
//
// A frame has a palette if twice the pixels that the CCD's counts stand for (their sum × the FVC's `sample`)
// exceed 33 N, the bits of N entries. A frame has code lengths if the symbols counted in the frame before
// take over 7840 bits more with the fixed lengths than with the lengths learned from them. Blocks of one
// colour and noise (kLccNoise) are not counted. Other raw blocks are counted with the symbols that they would
// have.
#pragma once

#include <cstdint>
#include <deque>

#include "dcp/ccd_view.h"
#include "lcc/lcc_codes.h"
#include "lcc/lcc_kernels.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// A status is the number of a colour of the CCD (the whole block has it, and takes no burst), or 64 (raw),
/// or 64 + bursts.
constexpr uint32_t kLccSolidColors = 64;

constexpr uint32_t kLccPixelBits = 32;
constexpr uint32_t kLccOpaque = 255;

class LccModel {
 public:
  LccModel(const FvcConfig& fvc, const CcdView& view) : fvc_(fvc), view_(view) {}

  const FvcConfig& fvc() const { return fvc_; }
  /// Decides which tables the frame has. A table is left out where it would cost more than it saved in the
  /// frame before.
  void begin_frame();
  void see_block(const BlockContext& block);

  bool has_palette() const { return has_palette_; }
  bool has_codes() const { return has_codes_; }
  const Ccd& ccd() const { return *view_.ccd; }
  const CcdView& view() const { return view_; }
  /// Bits of an index into the palette, and the indices of the block at hand; 0 and null without palette.
  uint32_t index_bits() const { return has_palette_ ? ccd().index_bits() : 0; }
  const uint16_t* indices() const { return has_palette_ ? view_.indices : nullptr; }
  /// Bits of the CCD as a table.
  uint64_t palette_bits() const { return uint64_t{ccd().entries} * (kLccPixelBits + 1); }
  const LccLengths& lengths() const { return lengths_; }
  /// The codes of lengths().
  const LccCodes& codes() const;

  /// The block at hand. It has planes unless it is solid.
  const LccPlanes& planes() const { return planes_; }
  /// Bits of the first pixel and of all symbols.
  uint32_t bits() const { return bits_; }
  /// True if the block is coded by its status alone.
  bool is_solid(const BlockContext& block) const {
    return block.uniform && has_palette_ && view_.indices[0] < kLccSolidColors;
  }
  uint32_t first_index() const { return has_palette_ ? view_.indices[0] : kNotInCcd; }

 private:
  uint32_t first_pixel_bits(uint32_t pixel) const;
  void choose_palette();
  void choose_codes();

  const FvcConfig fvc_;
  const CcdView& view_;
  bool has_palette_ = false, has_codes_ = false;
  LccLengths lengths_ = LccLengths::fixed();
  mutable LccCodes codes_;  ///< made when a block is written: to measure takes the lengths alone
  mutable bool codes_made_ = false;
  const LccKernels& kernels_ = lcc_kernels();
  LccPlanes planes_;
  uint32_t bits_ = 0;
  LccCounts counts_{};
  LccCounts ignored_{};  ///< counts of blocks that nothing is learned from
};

/// The shared analysis of LCC.
class LccSource final : public BlockAnalysis {
 public:
  explicit LccSource(const FormatTraits&) {}
  LccModel& model_of(const FvcConfig& fvc, const CcdView& view);
  void begin_frame(const FrameContext&) override {
    for (LccModel& model : models_) model.begin_frame();
  }
  void see_block(const BlockContext& block) override {
    for (LccModel& model : models_) model.see_block(block);
  }

 private:
  std::deque<LccModel> models_;  ///< a deque: encoders keep references
};

}  // namespace tilepress
