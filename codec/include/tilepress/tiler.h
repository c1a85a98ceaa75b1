// Tiler: visits the blocks of a surface in the order a tile-based GPU commits them (spec §2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "tilepress/block.h"

namespace tilepress {

/// Calls visit(bx, by) for every block: render tiles in raster order, in a tile blocks in raster order.
/// `tile_side` is in pixels, a multiple of 8. Block counts are those of the surface, rounded up. Before the
/// tiles whose blocks begin in rows `begin` to `end` of blocks, begin_tiles(begin, end) is called.
template <typename BeginTiles, typename Visit>
void for_each_block(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side, BeginTiles&& begin_tiles,
                    Visit&& visit) {
  const uint32_t step = tile_side / kBlockSide;
  for (uint32_t ty = 0; ty < blocks_y; ty += step) {
    const uint32_t end_y = std::min(ty + step, blocks_y);
    begin_tiles(ty, end_y);
    for (uint32_t tx = 0; tx < blocks_x; tx += step)
      for (uint32_t by = ty; by < end_y; ++by)
        for (uint32_t bx = tx; bx < std::min(tx + step, blocks_x); ++bx) visit(bx, by);
  }
}

template <typename Visit>
void for_each_block(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side, Visit&& visit) {
  for_each_block(
      blocks_x, blocks_y, tile_side, [](uint32_t, uint32_t) {}, std::forward<Visit>(visit));
}

}  // namespace tilepress
