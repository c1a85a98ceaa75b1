// DRAM text: a preset of --dram in words.
#pragma once

#include <string>

#include "tilepress/dram_presets.h"

namespace tilepress {

/// "burst 256 bits, 32 wires, 1600 MT/s; SOURCE"
inline std::string dram_text(const DramPreset& preset) {
  std::string out = "burst " + std::to_string(preset.burst_bits) + " bits";
  if (preset.width_bits != 0)
    out += ", " + std::to_string(preset.width_bits) + " wires, " + std::to_string(preset.transfers_mt_s) + " MT/s";
  return out + "; " + std::string(preset.source);
}

}  // namespace tilepress
