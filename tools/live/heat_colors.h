// Heat colours: how the report and the live view show the bits of blocks, dark for few and yellow for many.
#pragma once

#include <array>
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
std::array<uint8_t, 3> heat_color(double share);

}  // namespace tilepress
