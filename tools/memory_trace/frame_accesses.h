// Frame accesses: what writing a frame to memory and showing it once touches, in order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tilepress/compressed_surface.h"
#include "tilepress/surface_reader.h"

namespace tilepress {

/// Which form of the frame moves.
enum class TracedForm : uint8_t {
  kCompressed,
  kRaw,  ///< every block raw, at the same addresses; no CSB and no tables
};

// Both need the shape, block_bits, csb_bits and table_bits of `frame`. Its payload, CSB and tables may be empty.

/// Blocks in traversal order (tilepress/tiler.h), each the bursts that its payload fills; then the CSB plane
/// and the tables in whole bursts.
std::vector<MemoryFetch> frame_writes(const CompressedSurface& frame, TracedForm form);

/// The tables once; then rows of blocks from top to bottom, each block the bursts that it fills. Each burst of
/// the CSB plane is read once, before the first block that needs it.
std::vector<MemoryFetch> display_reads(const CompressedSurface& frame, TracedForm form);

/// Copies `out.size()` bytes of a part, from `offset_bytes` on. Bytes that nothing fills are zero.
void copy_part(const CompressedSurface& frame, SurfacePart part, uint64_t offset_bytes, std::span<uint8_t> out);

}  // namespace tilepress
