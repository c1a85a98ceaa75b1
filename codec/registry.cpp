// Registry: the schemes in the order users see them.
#include "registry.h"

#include "plugin/plugin_table.h"

namespace tilepress {
namespace {

std::deque<SchemeInfo>& schemes() {
  // Never destroyed: engines of other threads may outlive static objects.
  static auto& registered = *new std::deque<SchemeInfo>{
      kDcpInfo,     kAdcpInfo,     kVdcpInfo, kHuffDcpInfo, kRasInfo,    kRedInfo,     kHdcpInfo,
      kPaletteInfo, kFbcInfo,      kTeInfo,   kBdiInfo,     kBpcInfo,    kFpcInfo,     kFpcdInfo,
      kCpackInfo,   kFreqValsInfo, kHiloInfo, kMsaaInfo,    kIntel8Info, kIntel11Info, kAmdDccInfo,
      kLccInfo,
  };
  return registered;
}

}  // namespace

const char* name_of(SchemeGroup group) {
  constexpr const char* kNames[kSchemeGroups] = {"paper", "literature", "hardware", "ours"};
  return kNames[static_cast<size_t>(group)];
}

const std::deque<SchemeInfo>& scheme_registry() {
  return schemes();
}

const SchemeInfo* find_scheme(std::string_view name) {
  for (const SchemeInfo& scheme : schemes())
    if (name == scheme.name) return &scheme;
  return nullptr;
}

std::vector<std::string> unsupported_schemes(std::span<const SchemeSpec> schemes, PixelFormat format) {
  std::vector<std::string> lines;
  for (const SchemeSpec& spec : schemes)
    if (!find_scheme(spec.name)->supports(format))
      lines.push_back(spec.text + ": skipped: the scheme supports RGBA8 and RGBX8 only, the surface is " +
                      std::string(traits(format).name));
  return lines;
}

Result<void> register_scheme(const SchemeInfo& info) {
  const std::string_view name = info.name;
  const auto fail = [&](const char* reason) {
    return Error{ErrorKind::kBadValue, "scheme '" + std::string(name) + "': " + reason};
  };
  if (name.empty() || name.find_first_of(":,\" \n") != name.npos) return fail("not a name for a scheme");
  if (find_scheme(name) != nullptr) return fail("there is a scheme of this name already");
  if (info.columns.size() + info.added_columns.size() > kOwnCounts) return fail("more than 4 columns");
  schemes().push_back(info);
  return {};
}

void forget_newest_scheme() {
  schemes().pop_back();
}

}  // namespace tilepress
