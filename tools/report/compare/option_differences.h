// Option differences: options that change a run's rows and that two runs do not share.
#pragma once

#include <string>
#include <vector>

namespace tilepress {

/// Returns "tile 32 in A, 64 in B" for each such option that both run.json files name, in the order of the
/// options' table. The schemes are left out, and --verify, which changes no size.
std::vector<std::string> option_differences(const std::string& run_a, const std::string& run_b);

}  // namespace tilepress
