// Program kind: whether a program file can be preloaded into at all.
#pragma once

#include <string>

namespace tilepress {

/// The reason why LD_PRELOAD cannot reach `path` (statically linked, of another word size, set-user-ID), or
/// empty.
std::string preload_obstacle(const std::string& path);

}  // namespace tilepress
