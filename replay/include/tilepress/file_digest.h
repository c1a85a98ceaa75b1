// File digest: SHA-256 of a file, which identifies a trace, and of bytes in memory.
#pragma once

#include <string>
#include <string_view>

#include "tilepress/result.h"

namespace tilepress {

/// Returns the SHA-256 of the file's bytes in lower-case hexadecimal, 64 characters. Error: kFile if the file
/// cannot be read, kSystem if libcrypto fails.
Result<std::string> sha256_of_file(const std::string& path);

/// The same for bytes in memory. Error: kSystem.
Result<std::string> sha256_of_bytes(std::string_view bytes);

}  // namespace tilepress
