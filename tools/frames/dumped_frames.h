// Dumped frames: turns the raw pixels that a run kept into PNG files.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Replaces each frames/<surface>-<frame>.rgba of a run by a .png, alpha as it is. Pixels of formats other than
/// 8 bits a channel stay raw. A run without such files is no error.
Result<void> convert_dumped_frames(const std::string& run_path);

}  // namespace tilepress
