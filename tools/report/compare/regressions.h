// Regressions: rates that fell by more than a threshold, as text for people and for the tools that run tests.
#pragma once

#include <string>
#include <vector>

#include "report/compare/run_comparison.h"

namespace tilepress {

/// One check of a workload: a scheme's rate, or that B has what A has.
struct RateCheck {
  std::string workload, subject;
  std::string fault;  ///< empty: passed
};

/// A check for each scheme of each run. A scheme or a run that B lacks fails: it may be worse. `unpaired` has
/// a line for each run without a partner.
std::vector<RateCheck> check_rates(const std::vector<RunComparison>& runs,
                                   const std::vector<std::string>& unpaired, double threshold_percent);

/// A JUnit document with a test suite per workload.
std::string junit_xml(const std::vector<RateCheck>& checks);

/// Workflow commands of GitHub Actions: an error for each failed check, or one notice if all passed; before
/// them a warning for each remark.
std::string github_annotations(const std::vector<RateCheck>& checks, const std::vector<std::string>& remarks);

}  // namespace tilepress
