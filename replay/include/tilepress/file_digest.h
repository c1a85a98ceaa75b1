// File digest: SHA-256 of a file, which identifies a trace.
#pragma once

#include <optional>
#include <string>

namespace tilepress {

/// Returns the SHA-256 of the file's bytes in lower-case hexadecimal, 64 characters. Returns nothing, with one
/// line in `error`, if the file cannot be read.
std::optional<std::string> sha256_of_file(const std::string& path, std::string& error);

}  // namespace tilepress
