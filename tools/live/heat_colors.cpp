// Heat colours: linear interpolation.
#include "live/heat_colors.h"

#include <algorithm>
#include <cmath>

namespace tilepress {

std::array<uint8_t, 3> heat_color(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const size_t low = std::min<size_t>(static_cast<size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(low);
  std::array<uint8_t, 3> out{};
  for (size_t c = 0; c < 3; ++c)
    out[c] = static_cast<uint8_t>(std::lround(kViridis[low][c] * (1 - part) + kViridis[low + 1][c] * part));
  return out;
}

}  // namespace tilepress
