// Shared file: a small file that a capture makes and maps, for others to map.
#pragma once

#include <cstddef>
#include <string>

namespace tilepress {

/// Makes a file of `bytes` zero bytes that was not there before and maps it. Null and errno on failure, and
/// then no file is left. munmap() ends the mapping.
void* create_shared_file(const std::string& path, size_t bytes);

/// Maps the whole of a file that is at least `least_bytes` long, to write as well if `writable`. Null on
/// failure: errno, or 0 if the file is too short.
void* map_shared_file(const std::string& path, size_t least_bytes, bool writable, size_t& bytes);

}  // namespace tilepress
