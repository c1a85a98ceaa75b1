// File bytes: whole reads and writes at an offset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace tilepress {

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Returns false with errno set. An early end of the file is EIO.
bool read_at(int fd, uint64_t offset, std::span<std::byte> out);
bool write_at(int fd, uint64_t offset, std::span<const std::byte> bytes);

}  // namespace tilepress
