// FVC configuration: the key table and its rules.
#include "dcp/fvc_config.h"

namespace tilepress {

constexpr std::array<SchemeKey, 6> kDcpKeys = {{
    {.name = "fvc",
     .kind = KeyKind::kPowerOfTwo,
     .summary = "entries of the FVC and of the CCD",
     .low = 2,
     .high = 1024,
     .initial = 64,
     .range = KeyRange::kDoubling},
    {.name = "policy",
     .kind = KeyKind::kChoice,
     .summary = "which entry a miss evicts",
     .choices = "lfc, 2lfc, lru, random"},
    {.name = "ways",
     .summary = "associativity: entries of a set",
     .low = 1,
     .high = 1024,
     .help_values = "a divisor of fvc, or full",
     .help_initial = "full",
     .zero_word = "full",
     .range = KeyRange::kDoubling},
    {.name = "sample",
     .summary = "every n-th pixel enters the FVC",
     .low = 1,
     .initial = 1,
     .range = KeyRange::kCounting},
    {.name = "period",
     .summary = "the FVC collects in every n-th frame",
     .low = 1,
     .initial = 1,
     .range = KeyRange::kCounting},
    {.name = "coverage", .kind = KeyKind::kShare, .summary = "off while the FVC covers less than this"},
}};

FvcConfig fvc_config(const SchemeSpec& spec) {
  FvcConfig config{.entries = spec.number("fvc"),
                   .policy = static_cast<FvcPolicy>(spec.number("policy")),
                   .ways = spec.number("ways"),
                   .sample = spec.number("sample"),
                   .period = spec.number("period")};
  if (config.ways == config.entries) config.ways = 0;  // the same FVC, so that schemes share it
  return config;
}

Result<void> check_dcp_keys(const SchemeSpec& spec, std::span<const std::string_view>) {
  const uint32_t ways = spec.number("ways"), entries = spec.number("fvc");
  if (ways == 0 || entries % ways == 0) return {};
  return Error{ErrorKind::kBadValue,
               "ways=" + std::to_string(ways) + ": must divide the FVC size " + std::to_string(entries)};
}

}  // namespace tilepress
