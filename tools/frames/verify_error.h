// Verify error: what --verify reports.
#pragma once

#include <cstdint>
#include <string>

#include "counted.h"
#include "tilepress/result.h"

namespace tilepress {

/// Precondition: mismatched_blocks > 0.
inline Error verify_error(const std::string& scheme, uint64_t frame, uint64_t mismatched_blocks) {
  return {ErrorKind::kBadBits, "--verify: " + scheme + ": frame " + std::to_string(frame) + ": " +
                                   counted(mismatched_blocks, "block") +
                                   (mismatched_blocks == 1 ? " differs" : " differ") + " after decoding"};
}

}  // namespace tilepress
