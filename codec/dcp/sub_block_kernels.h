// Sub-block kernels: fast versions of what sub_blocks.h defines for a whole block.
#pragma once

#include <cstdint>

#include "cpu/cpu_target.h"

namespace tilepress {

struct WrittenBlock {
  uint32_t bits;         ///< of the payload
  uint32_t clean_bytes;  ///< the first so many bytes hold the payload and zeros; a multiple of 64
  uint64_t marks[2];     ///< of eight sub-blocks each: the low bits of their widths, the first on top
};

constexpr uint32_t kNotAllIndices = 0xFFFFFFFF;

/// A null pointer means: on this target the plain code is the fastest.
struct SubBlockKernels {
  /// Writes the payload of a block of 32-bit pixels with index widths up to kMaxKernelWidth, see
  /// write_payload_plainly(). Writes from the most significant bit of out[0] on and may overwrite 256 bytes.
  /// Each mark has `mark_bits` ≤ 7 bits.
  WrittenBlock (*write)(const uint32_t* pixels, const uint16_t* indices, const uint8_t* widths,
                        uint32_t mark_bits, uint8_t* out);

  /// Reads a payload that has only indices of up to `most_bits` ≤ 7 bits, below `known` ≤ 64. Reads 64 bytes;
  /// `colors` has 64 entries. Puts the pixels into raster order and returns the number of bits. Returns
  /// kNotAllIndices for any other payload, and leaves `raster` undefined then.
  uint32_t (*read)(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits, uint32_t most_bits,
                   const uint32_t* colors, uint32_t known, uint32_t* raster);
};

extern const KernelSets<SubBlockKernels> kSubBlockKernelSets;
inline const SubBlockKernels& sub_block_kernels() {
  return kSubBlockKernelSets.in_use();
}

#if defined(__x86_64__)
extern const SubBlockKernels kVbmiSubBlockKernels;
#endif

}  // namespace tilepress
