// CCD view: the dictionary in force and the block at hand looked up in it, for encoders.
#pragma once

#include <cstdint>
#include <optional>

#include "dcp/ccd.h"
#include "dcp/fvc_config.h"
#include "tilepress/statistics.h"

namespace tilepress {

struct CcdView {
  const Ccd* ccd = nullptr;  ///< null until the first FVC has filled a dictionary
  const uint16_t* indices =
      nullptr;  ///< of 64 pixels in traversal order; kNotInCcd where the CCD lacks the colour
  const uint8_t* widths = nullptr;        ///< by sub-block: bit width of its largest index, or kRawWidth
  std::optional<FvcFigures> collected{};  ///< after the frame: figures of the FVC, if it collected
};

/// The shared analysis of the DCP family.
class CcdSource : public BlockAnalysis {
 public:
  /// Returns the view of a configuration. The view changes from frame to frame and from block to block.
  virtual const CcdView& view_of(const FvcConfig& config) = 0;
};

}  // namespace tilepress
