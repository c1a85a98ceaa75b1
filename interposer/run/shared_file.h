// Shared file: a small file that a capture makes and maps, and that watchers map.
#pragma once

#include <cstddef>
#include <string>

namespace tilepress {

/// Makes a new file of `bytes` zero bytes and maps it. Returns null with errno on failure, and leaves no
/// file. munmap() ends the mapping.
void* create_shared_file(const std::string& path, size_t bytes);

/// Maps a whole file of at least `least_bytes`. Returns null with errno on failure; errno is 0 if the file is
/// too short.
void* map_shared_file(const std::string& path, size_t least_bytes, bool writable, size_t& bytes);

}  // namespace tilepress
