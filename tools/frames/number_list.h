// Number list: parses "720x1280", "10,-20" and the like.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

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

}  // namespace tilepress
