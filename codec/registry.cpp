// Registry: every scheme there is, one line each, in the order users see them.
#include "scheme_factory.h"

namespace tilepress {

std::span<const SchemeInfo> scheme_registry() {
  static const SchemeInfo kSchemes[] = {
      kDcpInfo,  kAdcpInfo,    kVdcpInfo, kHuffDcpInfo, kRasInfo, kRedInfo,
      kHdcpInfo, kPaletteInfo, kFbcInfo,  kTeInfo,      kBdiInfo, kBpcInfo,
  };
  return kSchemes;
}

const SchemeInfo* find_scheme(std::string_view name) {
  for (const SchemeInfo& scheme : scheme_registry())
    if (name == scheme.name) return &scheme;
  return nullptr;
}

}  // namespace tilepress
