// Plural: counts in sentences.
#pragma once

#include <cstdint>
#include <string>

namespace tilepress {

/// "1 frame", "2 frames"
inline std::string plural(uint64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace tilepress
