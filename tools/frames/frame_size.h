// Frame size: width and height in pixels, as "720x1280" on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frames/number_list.h"
#include "tilepress/surface.h"

namespace tilepress {

struct FrameSize {
  uint32_t width = 0, height = 0;
  uint64_t pixels() const { return uint64_t{width} * height; }
  std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
  /// Whether both sides are in 1..kMaxSurfaceSide.
  bool is_possible() const {
    return width >= 1 && height >= 1 && width <= kMaxSurfaceSide && height <= kMaxSurfaceSide;
  }
  bool operator==(const FrameSize&) const = default;
};

/// Parses "720x1280". Returns nothing unless both sides are in 1..kMaxSurfaceSide.
inline std::optional<FrameSize> parse_frame_size(const std::string& text) {
  const auto sides = parse_numbers<uint32_t, 2>(text, 'x');
  if (!sides) return std::nullopt;
  const FrameSize size{(*sides)[0], (*sides)[1]};
  return size.is_possible() ? std::optional(size) : std::nullopt;
}

}  // namespace tilepress
