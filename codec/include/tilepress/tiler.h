// Tiler: the order in which a tile-based GPU commits the blocks of a surface.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// Calls visit(bx, bx_end, by) for each row of blocks of each tile in one row of render tiles, rows `begin`
/// to `end` of blocks. Tiles go from left to right, the blocks of a tile in raster order. `tile_side` is in
/// pixels, a multiple of 8.
template <typename Visit>
void for_each_row_in_tiles(uint32_t blocks_x, uint32_t begin, uint32_t end, uint32_t tile_side,
                           Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t tx = 0; tx < blocks_x; tx += step)
    for (uint32_t by = begin; by < end; ++by) visit(tx, std::min(tx + step, blocks_x), by);
}

/// Calls visit(bx, by) for each block of a surface in the order of commitment.
template <typename Visit>
void for_each_block_in_tiles(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side, Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t row = 0; row < blocks_y; row += step)
    for_each_row_in_tiles(blocks_x, row, std::min(row + step, blocks_y), tile_side,
                          [&](uint32_t bx, uint32_t bx_end, uint32_t by) {
                            for (; bx < bx_end; ++bx) visit(bx, by);
                          });
}

}  // namespace tilepress
