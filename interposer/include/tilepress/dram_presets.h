// DRAM presets: the burst of common memories, for --dram.
#pragma once

#include <cstdint>
#include <string_view>

namespace tilepress {

struct DramPreset {
  std::string_view name;
  uint32_t burst_bits;
  uint32_t width_bits;      ///< of a channel's data bus; 0 = the source does not say
  uint32_t transfers_mt_s;  ///< millions of transfers a second on each wire; 0 = the source does not say
  std::string_view source;
};

/// A burst is width · burst length. `paper` states its burst alone.
constexpr DramPreset kDramPresets[] = {
    {"paper", 128, 0, 0, "Gubran et al., table of the configuration"},
    {"lpddr3", 256, 32, 1600, "JEDEC JESD209-3, x32, burst length 8"},
    {"lpddr4", 256, 16, 3200, "JEDEC JESD209-4, x16 channel, burst length 16"},
    {"lpddr5", 256, 16, 6400, "JEDEC JESD209-5, x16 channel, burst length 16"},
};

}  // namespace tilepress
