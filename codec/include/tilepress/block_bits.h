// Block bits: the payload bits of each block of a frame, for heat maps and memory traces.
#pragma once

#include <cstdint>
#include <vector>

namespace tilepress {

struct BlockBits {
  uint32_t blocks_x = 0, blocks_y = 0;
  uint32_t raw_bits = 0;                       ///< of a block that is not compressed
  std::vector<std::vector<uint16_t>> schemes;  ///< in their order, blocks in raster order; empty: skipped
};

}  // namespace tilepress
