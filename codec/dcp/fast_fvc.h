// Fast FVC: holds what Fvc holds, slot for slot, and takes runs and blocks of pixels at once.
#pragma once

#include <cstdint>
#include <memory>

#include "dcp/fvc_config.h"
#include "dcp/slot_kernels.h"
#include "pixels/few_colors.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

class Fvc;

/// Pixels in traversal order that are not all equal, and what is known about them.
struct SeenPixels {
  const uint32_t* pixels;
  uint32_t count;        ///< at most 64
  bool found;            ///< FastFvc::lookup() has the answers for these pixels
  const FewColors* few;  ///< of a whole block of few colours; null: many or unknown
  uint64_t begins;       ///< see PixelKernels::run_begins; 0 if wants_runs() is false
};

/// Receives each pixel of a frame exactly once, in any order, before the frame ends.
class ColorListener {
 public:
  virtual ~ColorListener() = default;
  /// `count` pixels of one colour.
  virtual void see_run(uint32_t color, uint32_t count) = 0;
  /// `count` pixels, at most 64. Bit i of `alike`: pixel i has the colour of the one before it. Bit 0 has no
  /// meaning.
  virtual void see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) = 0;
};

/// Takes every pixel that it sees: sampling and periods are the caller's.
class FastFvc {
 public:
  virtual ~FastFvc() = default;
  virtual void reset() = 0;
  /// Takes `count` pixels of one colour in a row.
  virtual void see_run(uint32_t color, uint32_t count) = 0;
  virtual void see(const SeenPixels& seen) = 0;
  /// True if see() reads SeenPixels::begins.
  virtual bool wants_runs() const { return false; }
  /// Reports pixels to `listener` until store_to().
  virtual void listen(ColorListener* listener) = 0;
  /// A look-up that, done for the next block, makes see() faster; null if there is none.
  virtual MemberLookup* lookup() { return nullptr; }
  /// Call it after the last pixel. Copies slots, counts and samples to the plain FVC.
  virtual void store_to(Fvc& fvc) = 0;
};

/// Returns null if the plain FVC must collect.
std::unique_ptr<FastFvc> make_fast_fvc(const FvcConfig& config, const FormatTraits& format);

}  // namespace tilepress
