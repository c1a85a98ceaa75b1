// Tiler: visits the blocks of a surface in the order a tile-based GPU commits them (spec §2).
#pragma once

#include <algorithm>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// Goes through one row of render tiles, rows `begin` to `end` of blocks: tiles from left to right, in a tile
/// blocks in raster order. Calls visit(bx, bx_end, by) for each row of blocks of a tile. `tile_side` is in
/// pixels, a multiple of 8.
template <typename Visit>
void for_each_row_in_tiles(uint32_t blocks_x, uint32_t begin, uint32_t end, uint32_t tile_side,
                           Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t tx = 0; tx < blocks_x; tx += step)
    for (uint32_t by = begin; by < end; ++by) visit(tx, std::min(tx + step, blocks_x), by);
}

/// Calls visit(bx, by) for every block of a surface, row of tiles after row of tiles. Block counts are those
/// of the surface, rounded up.
template <typename Visit>
void for_each_block(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side, Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t ty = 0; ty < blocks_y; ty += step)
    for_each_row_in_tiles(blocks_x, ty, std::min(ty + step, blocks_y), tile_side,
                          [&](uint32_t bx, uint32_t bx_end, uint32_t by) {
                            for (; bx < bx_end; ++bx) visit(bx, by);
                          });
}

}  // namespace tilepress
