// Program kind: whether LD_PRELOAD works on a program file.
#pragma once

#include <string>

namespace tilepress {

/// Returns why LD_PRELOAD cannot reach `path` (statically linked, another word size, set-user-ID); empty if
/// it can.
std::string preload_obstacle(const std::string& path);

}  // namespace tilepress
