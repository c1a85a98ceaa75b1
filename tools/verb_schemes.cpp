// tilepress schemes: the registry for people, or as JSON.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "command_line.h"
#include "tilepress/scheme.h"
#include "verb.h"

namespace tilepress {
namespace {

struct SchemeKey {
  const char* name;
  const char* values;
  const char* standard;  ///< the default
  const char* summary;
  bool SchemeInfo::*taken_by;
};

constexpr SchemeKey kSchemeKeys[] = {
    {"fvc", "2, 4, 8 ... 1024", "64", "entries of the FVC and of the CCD", &SchemeInfo::takes_fvc_keys},
    {"policy", "lfc, 2lfc, lru, random", "lfc", "which entry a miss evicts", &SchemeInfo::takes_fvc_keys},
    {"ways", "a divisor of fvc", "fvc", "associativity; fvc itself is fully associative",
     &SchemeInfo::takes_fvc_keys},
    {"sample", "1 ...", "1", "every n-th pixel enters the FVC", &SchemeInfo::takes_fvc_keys},
    {"period", "1 ...", "1", "the FVC collects in every n-th frame", &SchemeInfo::takes_fvc_keys},
    {"coverage", "0 ... 1", "0", "off while the FVC covers less than this", &SchemeInfo::takes_fvc_keys},
    {"ycocg", "0, 1", "0", "transform to Y, Co, Cg, A first", &SchemeInfo::takes_ras_keys},
    {"sizes", "3, 2, burst", "3", "size classes of a block", &SchemeInfo::takes_ras_keys},
    {"file", "a path", "", "palette from a file of #RRGGBB or #RRGGBBAA lines",
     &SchemeInfo::takes_palette_keys},
    {"from", "first", "first", "palette from the surface's first frame", &SchemeInfo::takes_palette_keys},
    {"entries", "2, 4, 8 ... 1024", "64", "colours of the dictionary", &SchemeInfo::takes_entries_key},
    {"order", "raster, quad", "raster", "order of a block's pixels in memory lines",
     &SchemeInfo::takes_order_key},
};

void print_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SchemeInfo& scheme : scheme_registry()) {
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const SchemeKey& key : kSchemeKeys)
      if (scheme.*key.taken_by)
        keys.push_back({{"name", key.name},
                        {"values", key.values},
                        {"default", key.standard},
                        {"summary", key.summary}});
    list.push_back({{"name", scheme.name},
                    {"label", scheme.label},
                    {"summary", scheme.summary},
                    {"source", scheme.source},
                    {"keys", keys}});
  }
  std::printf("%s\n", list.dump(2).c_str());
}

void print_text() {
  for (const SchemeInfo& scheme : scheme_registry()) {
    std::printf("%-9s %s\n          %s\n", scheme.name, scheme.summary, scheme.source);
    std::string keys;
    for (const SchemeKey& key : kSchemeKeys)
      if (scheme.*key.taken_by) keys += std::string(keys.empty() ? "" : ", ") + key.name;
    if (!keys.empty()) std::printf("          keys: %s\n", keys.c_str());
  }
  std::printf("\nKeys:\n  %-9s %-23s %-8s %s\n", "key", "values", "default", "");
  for (const SchemeKey& key : kSchemeKeys)
    std::printf("  %-9s %-23s %-8s %s\n", key.name, key.values, key.standard, key.summary);
  std::printf(
      "\nA scheme is asked for as name:key=value,key=value, for example -s vdcp:fvc=128,policy=2lfc\n");
}

}  // namespace

int verb_schemes(int argc, char** argv) {
  CLI::App app("Lists the schemes, where each comes from, and the keys it takes.");
  bool json = false;
  app.add_flag("--json", json, "As JSON");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  json ? print_json() : print_text();
  return kExitDone;
}

}  // namespace tilepress
