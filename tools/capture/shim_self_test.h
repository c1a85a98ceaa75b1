// Shim self-test: runs the small program tilepress-self-test under the shim and checks its frames.
#pragma once

#include <string>

#include "tilepress/result.h"
#include "tilepress/shim_environment.h"

namespace tilepress {

/// Runs the program, which is beside `library` or in the folder tilepress/ beside it, under the shim by
/// `road`. Checks that every frame was captured with its pixels and that its blocks decode to them. Returns
/// one line about the success. Error: one line about the first failure.
Result<std::string> test_shim(const std::string& library, ShimRoad road);

}  // namespace tilepress
