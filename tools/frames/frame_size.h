// Frame size: width and height in pixels, and lists of numbers as "720x1280" on the command line.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tilepress/surface.h"

namespace tilepress {

/// Parses N whole numbers with `separator` between them. Returns nothing for any other text.
template <class T, size_t N>
std::optional<std::array<T, N>> parse_numbers(std::string_view text, char separator) {
  std::array<T, N> numbers{};
  const char *at = text.data(), *end = at + text.size();
  for (size_t i = 0; i < N; ++i) {
    const auto [next, status] = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == N;
    if (status != std::errc() || (last ? next != end : next == end || *next != separator))
      return std::nullopt;
    at = last ? next : next + 1;
  }
  return numbers;
}

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
