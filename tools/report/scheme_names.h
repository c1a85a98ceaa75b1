// Scheme names: what the registry knows about a scheme that a run names.
#pragma once

#include <optional>
#include <string>

#include "tilepress/cost_model.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// The registry's entry of "vdcp:fvc=128". Null for a scheme that this build does not have.
inline const SchemeInfo* scheme_info(const std::string& spec) {
  return find_scheme(spec.substr(0, spec.find(':')));
}

/// Empty for an unknown scheme.
inline std::string scheme_family(const std::string& spec) {
  const SchemeInfo* info = scheme_info(spec);
  return info != nullptr ? info->family : "";
}

/// Group of "vdcp:fvc=128"; `ours` for a scheme that this build does not have.
inline SchemeGroup scheme_group(const std::string& spec) {
  const SchemeInfo* info = scheme_info(spec);
  return info != nullptr ? info->group : SchemeGroup::kOurs;
}

/// The paper states an energy only for DCP's structures.
inline bool has_dcp_structures(const std::string& spec) {
  const SchemeInfo* info = scheme_info(spec);
  return info != nullptr && info->has_dcp_structures;
}

/// Share of DRAM energy that a scheme saves at a rate above 0 (paper §Energy Savings). Nothing for schemes
/// without DCP's structures.
inline std::optional<double> scheme_saving(const std::string& spec, double rate,
                                           const CostConstants& constants = {}) {
  if (!has_dcp_structures(spec)) return std::nullopt;
  return energy_saving(rate, constants);
}

/// Whether the scheme has more or fewer entries than those whose energy the paper states: figures of it say
/// so.
inline bool has_other_entries(const std::string& spec) {
  if (!has_dcp_structures(spec)) return false;
  const auto parsed = parse_scheme(spec);
  return parsed && parsed->number("fvc") != CostConstants{}.table_entries;
}

}  // namespace tilepress
