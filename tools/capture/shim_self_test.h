// Shim self-test: the tiny program tilepress-self-test under the shim, its frames looked at.
#pragma once

#include <string>

#include "tilepress/shim_environment.h"

namespace tilepress {

struct SelfTestResult {
  bool passed = false;
  std::string detail;  ///< one line
};

/// Runs the program, which lies beside `library` or in the folder tilepress/ beside it, under the shim by
/// `road` and checks that every frame was captured, with its pixels, and decodes to itself.
SelfTestResult test_shim(const std::string& library, ShimRoad road);

}  // namespace tilepress
