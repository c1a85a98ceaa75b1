// Frame parameters: the numbers of a frame's vectors, as Verilog takes them.
#pragma once

#include <cstdint>
#include <string>

#include "tilepress/compressed_surface.h"
#include "tilepress/fvc_follower.h"

namespace tilepress {

/// What the files of one frame hold.
struct VectorFrame {
  uint64_t frame = 0;    ///< number of the input frame
  uint64_t ordinal = 0;  ///< number of the modelled frame
  uint64_t first = 0;    ///< number of the first block written, in the order of commitment
  uint64_t blocks = 0;   ///< written
  uint32_t pixel_bits = 32, payload_width = 2048, csb_bits = 0;
  uint64_t table_bits = 0;
  uint32_t fvc_entries = 0;  ///< 0 = the scheme has no FVC
  bool fvc_collects = false, fvc_has_last = false;
  uint32_t ccd_colors = 0;
};

/// The FVC before the first and after the last block written.
struct FvcPair {
  FvcState before_blocks, after_blocks;
};

/// The text of frame.vh.
std::string parameters_text(const VectorFrame& frame, const CompressedSurface& surface,
                            const FvcPair& states);

}  // namespace tilepress
