// Text file: stores a whole file of a study folder, which several processes on several hosts write at the
// same time.
#pragma once

#include <string>
#include <string_view>

#include "tilepress/result.h"

namespace tilepress {

/// Replaces the file in one step, after its bytes have reached the disk. Each call writes under a name of its
/// own before, so that calls for one path never mix. Makes the folder. Error: kFile, the path first.
Result<void> store_text_file(const std::string& path, std::string_view text);

}  // namespace tilepress
