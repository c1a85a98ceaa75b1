// Expected picture: the pixels of the known picture, to compare captured frames with.
#pragma once

#include <cstdint>
#include <vector>

#include "programs/known_picture.h"

namespace tilepress::testing {

/// Returns R,G,B,A bytes, top row first. Without alpha every A is 255.
inline std::vector<uint8_t> expected_picture(unsigned frame, int width, int height, bool with_alpha) {
  known_box boxes[KNOWN_BOXES];
  known_picture(frame, width, height, boxes);
  std::vector<uint8_t> pixels(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  for (const known_box& box : boxes)
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        uint8_t* pixel =
            &pixels[(static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 4];
        for (int c = 0; c < 4; ++c) pixel[c] = c == 3 && !with_alpha ? 255 : box.color[c];
      }
  return pixels;
}

}  // namespace tilepress::testing
