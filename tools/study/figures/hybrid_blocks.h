// Hybrid blocks: which coder took the blocks of a hybrid scheme.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "study/figures/study_data.h"

namespace tilepress {

/// `vdcp` and `ras` count every block once. `raw` counts the blocks among them that stay raw; NaN in results
/// of older versions.
struct HybridBlocks {
  double vdcp, ras, raw;

  double all() const { return vdcp + ras; }
  /// Blocks that a coder makes smaller. A block raw either way counts as VDCP's, unless the coverage
  /// threshold switched VDCP off.
  double vdcp_only() const { return vdcp - raw_vdcp(); }
  double ras_only() const { return ras - (std::isnan(raw) ? 0 : raw - raw_vdcp()); }

 private:
  double raw_vdcp() const { return std::isnan(raw) ? 0 : std::min(raw, vdcp); }
};

inline HybridBlocks hybrid_blocks(const StudyData& data, const std::string& workload,
                                  const std::string& configuration) {
  const auto count = [&](const char* column) { return data.result(workload, configuration, column); };
  return {count("vdcp_blocks"), count("ras_blocks"), count("raw_blocks")};
}

}  // namespace tilepress
