// Model options: the modelled hardware, and what the engine checks and measures beside.
#pragma once

#include <cstdint>

namespace tilepress {

struct ModelOptions {
  uint32_t tile_side = 32;    ///< render tile, pixels; a multiple of 8, 8..4096
  uint32_t burst_bits = 128;  ///< DRAM transfer unit; a power of two, 16..2048
  bool verify = false;        ///< encode, decode and compare every block of every frame
  bool frame_metrics = true;  ///< off: FrameStatistics::metrics stays zero
  uint32_t toggle_bits = 0;   ///< toggles of a bus of so many bits: 16 or 32, at most a burst; 0 = off
};

}  // namespace tilepress
