// Claims: numbers that the paper's text states, beside those of the study.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/html_text.h"
#include "study/figures/study_data.h"

namespace tilepress {

enum class ClaimUnit : uint8_t {
  kRate,
  kShare,
  kBitsPerPixel,
  kBytes,
  kSquareMillimetres,
  kMilliwatts,
  kPicojoules
};

/// Where the study's number comes from.
enum class ClaimSource : uint8_t {
  kWorkloadMean,   ///< mean of a column of workloads.csv over the category
  kStandIn,        ///< that column, of the workload that stands for the paper's
  kMean,           ///< a column of means.csv
  kRelative,       ///< the same, divided by that of the base configuration
  kGain,           ///< kRelative − 1
  kSaving,         ///< energy saved at the mean rate
  kLargest,        ///< largest value of a column of results.csv in the category
  kLowestCovered,  ///< lowest value among workloads with an FVC coverage of 0.7 or more
  kHybridShare,    ///< mean over workloads of VDCP's share of the blocks that are not raw
  kCostModel,      ///< the cost model alone
};

/// One number of the paper.
struct ClaimRule {
  const char* id;
  const char* section;  ///< of the paper
  const char* text;     ///< what the number is
  ClaimUnit unit;
  double published;
  const char* category;  ///< "all": the paper names none
  ClaimSource source;
  const char* column = "";
  const char* configuration = "";
  const char* base = "";
  const char* note = "";       ///< why numbers may differ, where known
  double (*cost)() = nullptr;  ///< for kCostModel
};

/// The numbers of the paper's text, in its order.
std::span<const ClaimRule> claim_rules();

struct Claim {
  ClaimRule rule;
  double ours;               ///< NaN: the study has nothing to compare
  size_t workloads;          ///< that the number comes from
  std::string stands_for{};  ///< the workload, for kStandIn
  std::string reason{};      ///< why the numbers differ, as far as the study itself shows it
  /// ours / published − 1. Gains are compared as ratios: (1 + ours) / (1 + published) − 1.
  double deviation() const {
    const double offset = rule.source == ClaimSource::kGain ? 1 : 0;
    return (ours + offset) / (rule.published + offset) - 1;
  }
};

std::vector<Claim> make_claims(const StudyData& data);

/// The value as people read it, with its unit.
std::string claim_value(double value, ClaimUnit unit);
/// For people: values with units.
Table claims_table(const std::vector<Claim>& claims);
/// Every field of every claim, shares as 0..1.
std::string claims_csv(const std::vector<Claim>& claims);

}  // namespace tilepress
