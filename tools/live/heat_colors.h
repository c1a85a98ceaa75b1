// Heat colours: how the report and the live view show the bits of blocks, dark for few and yellow for many.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tilepress {

/// Nine evenly spaced colours of the viridis map, ordered by brightness.
constexpr std::array<std::array<uint8_t, 3>, 9> kViridis = {{{68, 1, 84},
                                                             {71, 44, 122},
                                                             {59, 81, 139},
                                                             {44, 113, 142},
                                                             {33, 144, 141},
                                                             {39, 173, 129},
                                                             {92, 200, 99},
                                                             {170, 220, 50},
                                                             {253, 231, 37}}};

/// Returns R, G, B for a share of a raw block's bits, 0..1.
inline std::array<uint8_t, 3> heat_color(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const size_t low = std::min<size_t>(static_cast<size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(low);
  std::array<uint8_t, 3> out{};
  for (size_t c = 0; c < 3; ++c)
    out[c] = static_cast<uint8_t>(std::lround(kViridis[low][c] * (1 - part) + kViridis[low + 1][c] * part));
  return out;
}

}  // namespace tilepress
