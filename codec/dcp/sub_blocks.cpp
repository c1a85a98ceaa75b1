// Sub-blocks: writes them.
#include "dcp/sub_blocks.h"

#include "pixels/raw_bits.h"

namespace tilepress {

void write_payload_plainly(const SubBlocks& block, uint32_t pixel_bits, BitWriter& payload) {
  BitWriter out = payload;  // the compiler keeps a copy in registers
  for (uint32_t sub = 0, at = 0; sub < kSubBlocks; ++sub, at += kSubBlockPixels) {
    const uint32_t width = block.widths[sub];
    if (width == kRawWidth) {
      write_raw_pixels(block.pixels + at, kSubBlockPixels, pixel_bits, out);
      continue;
    }
    uint64_t indices = 0;  // four of at most 10 bits
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) indices = indices << width | block.indices[at + i];
    out.put(indices, kSubBlockPixels * width);
  }
  payload = out;
}

void write_payload(const SubBlocks& block, uint32_t largest_width, uint32_t pixel_bits, BitWriter& payload) {
  uint8_t* out =
      has_write_kernel(largest_width, pixel_bits) ? payload.at_byte(kMaxRawBlockBits / 8) : nullptr;
  if (out == nullptr) return write_payload_plainly(block, pixel_bits, payload);
  payload.wrote(
      sub_block_kernels().write(block.pixels, block.indices, block.widths, kMaxKernelWidth, out).bits);
}

void write_widths(const uint8_t* widths, uint32_t mark_bits, BitWriter& csb) {
  for (uint32_t half = 0; half < kSubBlocks; half += kSubBlocks / 2) {
    uint64_t marks = 0;
    for (uint32_t sub = half; sub < half + kSubBlocks / 2; ++sub)
      marks = marks << mark_bits | (widths[sub] & ((1u << mark_bits) - 1));  // kRawWidth becomes all ones
    csb.put(marks, kSubBlocks / 2 * mark_bits);
  }
}

namespace {
constexpr SubBlockKernels kNoSubBlockKernels = {};
}
#if defined(__x86_64__)
const KernelSets<SubBlockKernels> kSubBlockKernelSets =
    plain_and_vbmi(kNoSubBlockKernels, kVbmiSubBlockKernels);
#else
const KernelSets<SubBlockKernels> kSubBlockKernelSets =
    plain_and_vbmi(kNoSubBlockKernels, kNoSubBlockKernels);
#endif

}  // namespace tilepress
