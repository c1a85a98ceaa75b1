// FVC configuration: the keys of every scheme with an FVC (paper §Factors affecting FVC Fidelity).
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/scheme.h"

namespace tilepress {

/// Which entry a miss evicts.
enum class FvcPolicy : uint8_t { kLfc, k2Lfc, kLru, kRandom };

/// Everything that decides what an FVC collects. Schemes with equal configurations share one FVC and one CCD.
struct FvcConfig {
  uint32_t entries = 64;  ///< a power of two, 2..1024
  FvcPolicy policy = FvcPolicy::kLfc;
  uint32_t ways = 0;    ///< divides entries; 0 = fully associative
  uint32_t sample = 1;  ///< every sample-th pixel enters the FVC, ≥ 1
  uint32_t period = 1;  ///< the FVC collects in every period-th frame, ≥ 1
  bool operator==(const FvcConfig&) const = default;
  uint32_t ways_per_set() const { return ways == 0 ? entries : ways; }
};

extern const std::array<SchemeKey, 6> kDcpKeys;
/// The first so many decide what the FVC collects: all but `coverage`.
constexpr size_t kFvcKeys = 5;
/// Precondition: a specification of a scheme with the first kFvcKeys of kDcpKeys.
FvcConfig fvc_config(const SchemeSpec& spec);
/// See SchemeInfo::check.
Result<void> check_dcp_keys(const SchemeSpec& spec, std::span<const std::string_view> given);

}  // namespace tilepress
