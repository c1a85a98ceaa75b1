// Whole file: small files that are read, written or replaced as one.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

#include "tilepress/result.h"

namespace tilepress {

Result<std::string> read_whole_file(const std::string& path);

/// Makes the file with `mode`, or replaces what it holds. A failure can leave part of the bytes, and
/// errno has the reason too.
Result<void> write_whole_bytes(const std::string& path, std::string_view bytes, mode_t mode = 0666);

/// Replaces `path` in one step: a reader finds the old text or the new one. Writes to "path.tmp" and renames.
Result<void> replace_file(const std::string& path, std::string_view text);

}  // namespace tilepress
