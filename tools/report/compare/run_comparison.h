// Run comparison: two runs frame by frame and scheme by scheme, over the frames that both have.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/run_options.h"
#include "tilepress/run_reader.h"

namespace tilepress {

/// A frame under one scheme in both runs.
struct FramePair {
  uint64_t frame = 0;
  uint32_t surface = 0;
  SchemeStatistics a, b;
};

/// One scheme over the frames that both runs have. Rates are Σ raw / Σ moved.
struct SchemeComparison {
  std::string scheme;
  SchemeStatistics a, b;
  std::vector<FramePair> frames;   ///< in the order of run A, warm-up frames left out
  uint64_t better = 0, worse = 0;  ///< frames where B's rate is higher, lower
};

struct RunComparison {
  std::string name;                 ///< workload
  /// "tile 32 in A, 64 in B" for each option that changes rows and differs.
  std::vector<std::string> options;
  uint64_t common = 0;              ///< measured frames compared
  uint64_t only_a = 0, only_b = 0;  ///< measured frames that the other run lacks
  /// Common frames whose size or content metrics (colours, entropy) differ: not the same pictures.
  uint64_t different_pictures = 0;
  std::vector<std::string> schemes_only_a, schemes_only_b;
  std::vector<SchemeComparison> schemes;
};

/// A scheme of run A and the scheme of run B to compare with it.
struct SchemePair {
  std::string a, b;

  /// "vdcp", or "vdcp => hdcp" for two schemes.
  std::string text() const { return a == b ? a : a + " => " + b; }
};

/// Position of the scheme, or else of one with the same configuration: "vdcp" is "vdcp:fvc=64". names.size()
/// if there is none.
size_t scheme_position(const std::vector<std::string>& names, const std::string& scheme);

/// Compares the frames of `frames` (all if it is every frame). Without `map` the schemes of equal
/// configurations are compared, with it only its pairs.
RunComparison compare_runs(const RunRecord& a, const RunRecord& b, const FrameSet& frames,
                           const std::vector<SchemePair>& map = {});

/// Change from a to b as a share of a: 0.1 = 10 % more. 0 if both are equal, NaN if a is 0.
double relative_change(double a, double b);

}  // namespace tilepress
