// Scheme names: what the registry knows about a scheme that a run names.
#pragma once

#include <string>

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

}  // namespace tilepress
