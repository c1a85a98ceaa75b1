// Dumped frames: turns the raw pixels that a run kept into PNG files.
#pragma once

#include <string>

namespace tilepress {

/// Replaces each frames/<surface>-<frame>.rgba of a run by a .png, alpha kept as it is. Pixels of formats
/// other than 8 bits a channel stay raw. Nothing to do is no error; false and one line in `error` on failure.
bool convert_dumped_frames(const std::string& run_path, std::string& error);

}  // namespace tilepress
