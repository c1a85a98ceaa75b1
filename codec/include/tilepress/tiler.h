// Tiler: visits the blocks of a surface in the order a tile-based GPU commits them (spec §2).
#pragma once

#include <algorithm>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// Calls visit(bx, by) for the blocks of one row of render tiles, those in rows `begin` to `end` of blocks:
/// tiles from left to right, in a tile blocks in raster order. `tile_side` is in pixels, a multiple of 8.
template <typename Visit>
void for_each_block_of_tiles(uint32_t blocks_x, uint32_t begin, uint32_t end, uint32_t tile_side,
                             Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t tx = 0; tx < blocks_x; tx += step)
    for (uint32_t by = begin; by < end; ++by)
      for (uint32_t bx = tx; bx < std::min(tx + step, blocks_x); ++bx) visit(bx, by);
}

/// The same for every block of a surface, row of tiles after row of tiles. Block counts are those of the
/// surface, rounded up.
template <typename Visit>
void for_each_block(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side, Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t ty = 0; ty < blocks_y; ty += step)
    for_each_block_of_tiles(blocks_x, ty, std::min(ty + step, blocks_y), tile_side, visit);
}

}  // namespace tilepress
