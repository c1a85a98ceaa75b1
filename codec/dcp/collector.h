// Collector: an FVC configuration in use, what it collects, and the dictionary in force.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "dcp/ccd.h"
#include "dcp/fvc.h"
#include "dcp/lfc_collector.h"
#include "dcp/slot_kernels.h"
#include "tilepress/block.h"
#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {

/// Collects in the frames of its period and builds a CCD at the end of each, which serves the frames after
/// it.
class Collector {
 public:
  Collector(const FvcConfig& config, const FormatTraits& format);

  void begin_frame(uint64_t ordinal);
  /// After begin_frame(): `listener` is told of the pixels this sees until end_frame(). False, and it is not,
  /// if this does not collect in the frame, or not in a way that serves others.
  bool listen(ColorListener* listener);
  /// `count` pixels of one colour in a row.
  void see_run(uint32_t color, uint32_t count);
  /// Pixels in traversal order. Of a whole block also `few`, its colours if they are few, or null.
  void see_all(const uint32_t* pixels, uint32_t count, const FewColors* few);
  /// After the last pixel: fvc() holds what was collected.
  void end_frame();
  /// After end_frame(), for schemes that look colours up.
  void build_ccd();

  /// Of a block in traversal order: indices() and widths(), see BlockContext. Precondition: ccd() is there.
  void look_up(const uint32_t* pixels, bool uniform, const FewColors* few);
  /// As Kernels::load_traversal; and look_up(), unless all are equal, if there is a ccd() and it is wanted.
  /// What see_all() finds out about the pixels is found at once: unless they are all equal, that is to come
  /// next.
  bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);

  const Fvc& fvc() const { return fvc_; }
  const Ccd* ccd() const { return has_ccd_ ? &ccd_ : nullptr; }  ///< null: none yet
  const uint16_t* indices() const { return indices_.data(); }
  const uint8_t* widths() const { return widths_.data(); }

  bool wanted = false;  ///< a scheme looks colours up in its CCD

 private:
  Fvc fvc_;
  std::unique_ptr<LfcCollector> fast_;  ///< collects in the place of fvc_ where it can, to the same result
  Ccd ccd_;
  CcdLookup lookup_;
  bool has_ccd_ = false;
  bool collecting_ = false;  ///< in this frame
  std::array<uint16_t, kBlockPixels> indices_;
  std::array<uint8_t, kSubBlocks> widths_;
  std::array<uint8_t, kBlockPixels> slots_;
  SlotLookups lookups_{};   ///< of load()
  bool has_found_ = false;  ///< lookups_ holds what was found of the pixels to be seen next
};

}  // namespace tilepress
