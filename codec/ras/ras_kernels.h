// RAS kernels: prediction, folding and the choice of k for a block of samples. See ras_samples.h for the
// layouts.
#pragma once

#include "cpu/cpu_target.h"
#include "ras/ras_samples.h"

namespace tilepress {

struct RasKernels {
  /// Copies an 8×8 block of four 8-bit channels to ras_samples without the border.
  void (*widen_bytes)(const uint32_t* top_left, uint32_t stride, int16_t* samples);

  /// Returns the bits of the Golomb-Rice codes of four planes with their group headers, without the first
  /// pixels.
  uint32_t (*code_bits)(const int16_t* samples);

  /// Fills `groups` with residuals, k, lengths and codes.
  void (*groups)(const int16_t* samples, RasGroups& groups);

  /// Turns residuals into samples: adds to each what its neighbours predict. Pixel (x, y) is at 32 * y + 4 *
  /// x. Residuals that no encoder makes: all samples up to the first out of its range are exact.
  void (*restore)(int16_t* samples);

  /// Joins samples of four 8-bit channels, as restore leaves them, to pixels. Returns false if one does not
  /// fit.
  bool (*narrow_bytes)(const int16_t* samples, uint32_t* pixels);
};

extern const RasKernels kPlainRasKernels;
extern const KernelSets<RasKernels> kRasKernelSets;
inline const RasKernels& ras_kernels() {
  return kRasKernelSets.in_use();
}

}  // namespace tilepress
