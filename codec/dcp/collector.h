// Collector: the FVC and the dictionary of one configuration in use.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "dcp/ccd_view.h"
#include "dcp/fvc.h"
#include "dcp/lfc_collector.h"
#include "dcp/slot_kernels.h"
#include "tilepress/block.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

/// Collects in the frames of its period. Builds a CCD at the end of each such frame, for the frames after it.
class Collector {
 public:
  Collector(const FvcConfig& config, const FormatTraits& format);
  Collector(const Collector&) = delete;  // view() refers to this object

  void begin_frame(uint64_t ordinal);
  /// Call it after begin_frame(). Reports every pixel of the frame to `listener`. Returns false, and reports
  /// nothing, if this frame is not collected or only by the plain FVC.
  bool listen(ColorListener* listener);
  /// Takes `count` pixels of one colour in a row.
  void see_run(uint32_t color, uint32_t count);
  /// Takes pixels in traversal order. `few` has the colours of a whole block of few colours, else it is null.
  void see_all(const uint32_t* pixels, uint32_t count, const FewColors* few);
  /// Call it after the last pixel: fvc() is complete then.
  void end_frame();
  /// Call it after end_frame() if a scheme looks colours up.
  void build_ccd();

  /// Looks up a block in traversal order for view(). Precondition: ccd() is there.
  void look_up(const uint32_t* pixels, bool uniform, const FewColors* few);
  /// Loads a block, see PixelKernels::load_traversal. Unless all pixels are equal, also looks them up if the
  /// CCD is there and wanted, and prepares see_all(), which must be the next call.
  bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);

  const Fvc& fvc() const { return fvc_; }
  const Ccd* ccd() const { return view_.ccd; }  ///< null: none yet
  const CcdView& view() const { return view_; }

  bool wanted = false;  ///< a scheme looks colours up in its CCD

 private:
  Fvc fvc_;
  std::unique_ptr<LfcCollector> fast_;  ///< collects instead of fvc_ where it can, with the same result
  Ccd ccd_;
  CcdLookup lookup_;
  bool collecting_ = false;  ///< in this frame
  std::array<uint16_t, kBlockPixels> indices_;
  std::array<uint8_t, kSubBlocks> widths_;
  CcdView view_{.ccd = nullptr, .indices = indices_.data(), .widths = widths_.data()};
  std::array<uint8_t, kBlockPixels> slots_;
  SlotLookups lookups_{};   ///< of load()
  bool has_found_ = false;  ///< lookups_ holds the answers for the next see_all()
};

}  // namespace tilepress
