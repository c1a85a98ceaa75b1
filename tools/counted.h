// Counted: "1 frame", "2 frames".
#pragma once

#include <cstdint>
#include <string>

namespace tilepress {

/// `noun`: in the singular, with a regular plural.
inline std::string counted(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace tilepress
