// Collector: an FVC in use, in the fastest form that there is for it; and the dictionaries built from it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "dcp/ccd_view.h"
#include "dcp/fast_fvc.h"
#include "dcp/fvc.h"

namespace tilepress {

/// Collects one frame at a time for all configurations that differ in their period alone.
class Collector {
 public:
  Collector(const FvcConfig& config, const FormatTraits& format);

  /// Empties the FVC.
  void begin_frame();
  /// Call it after begin_frame(). Reports every pixel of the frame to `listener` by end_frame(). Returns
  /// false, and reports nothing, if the collector does not see every pixel.
  bool listen(ColorListener* listener) {
    if (takes_all_) fast_->listen(listener);
    return takes_all_;
  }
  /// Takes `count` pixels of one colour in a row.
  void see_run(uint32_t color, uint32_t count);
  void see(const SeenPixels& seen);
  bool wants_runs() const { return takes_all_ && fast_->wants_runs(); }
  /// See FastFvc.
  MemberLookup* lookup() { return takes_all_ ? fast_->lookup() : nullptr; }
  /// Call it after the last pixel: fvc() is complete then.
  void end_frame() {
    if (fast_) fast_->store_to(fvc_);
  }
  const Fvc& fvc() const { return fvc_; }

 private:
  Fvc fvc_;
  std::unique_ptr<FastFvc> fast_;  ///< collects instead of fvc_, with the same result; may be null
  const bool takes_all_;           ///< fast_ takes every pixel
  uint32_t until_sample_ = 1;      ///< 1: the next pixel is taken; 2: the one after it; …
};

/// A CCD in force, and the block at hand looked up in it.
struct Dictionary {
  Ccd ccd;
  CcdLookup lookup;
  std::array<uint16_t, kBlockPixels> indices;
  std::array<uint8_t, kSubBlocks> widths;

  void build(const Fvc& fvc) {
    ccd.build(fvc);
    lookup.build(ccd);
  }
  /// Looks up a block in traversal order. `few` has its colours if they are few, else it is null.
  void look_up(const uint32_t* pixels, const FewColors* few) {
    few != nullptr ? lookup.find_block(pixels, *few, indices.data(), widths.data())
                   : lookup.find_block(pixels, indices.data(), widths.data());
  }
  /// Looks up a block of one colour.
  void look_up_solid(uint32_t color) {
    indices.fill(lookup.find(color));
    widths.fill(width_of(indices[0]));
  }
};

}  // namespace tilepress
