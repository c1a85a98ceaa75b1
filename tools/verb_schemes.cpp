// tilepress schemes: prints the registry as text or as JSON.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

#include "command_line.h"
#include "common_options.h"
#include "dram_text.h"
#include "tilepress/scheme.h"
#include "verb.h"

namespace tilepress {
namespace {

/// `only`: the scheme to print, or null for all.
void print_json(const SchemeInfo* only) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SchemeInfo& scheme : scheme_registry()) {
    if (only != nullptr && only != &scheme) continue;
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const SchemeKey& key : scheme.keys)
      keys.push_back({{"name", key.name},
                      {"values", key.values()},
                      {"default", key.default_value()},
                      {"summary", key.summary}});
    list.push_back({{"name", scheme.name},
                    {"label", scheme.label},
                    {"group", name_of(scheme.group)},
                    {"summary", scheme.summary},
                    {"source", scheme.source},
                    {"keys", keys}});
  }
  std::printf("%s\n", list.dump(2).c_str());
}

void print_scheme(const SchemeInfo& scheme) {
  std::printf("  %-9s %s\n            %s\n", scheme.name, scheme.summary, scheme.source);
  std::string keys;
  for (const SchemeKey& key : scheme.keys) keys += std::string(keys.empty() ? "" : ", ") + key.name;
  if (!keys.empty()) std::printf("            keys: %s\n", keys.c_str());
  if (scheme.eight_bit_only) std::printf("            formats: RGBA8 and RGBX8 only\n");
}

/// What a group's schemes are, to follow its name.
const char* meaning_of(SchemeGroup group) {
  constexpr const char* kMeanings[kSchemeGroups] = {
      "the paper's own schemes, and RAS and RED, with which it compares them. Without -s: all of these",
      "yardsticks that were published elsewhere",
      "yardsticks that are in shipping GPUs",
      "made for tilepress, or registered by a program",
  };
  return kMeanings[static_cast<size_t>(group)];
}

void print_keys(const SchemeInfo& scheme, std::set<std::string_view>& printed) {
  for (const SchemeKey& key : scheme.keys)
    if (printed.insert(key.name).second)
      std::printf("  %-9s %-23s %-8s %s\n", key.name, key.values().c_str(), key.default_value().c_str(),
                  key.summary);
}

void print_keys_heading() {
  std::printf("\nKeys:\n  %-9s %-23s %-8s %s\n", "key", "values", "default", "");
}

/// One scheme with its keys.
void print_one(const SchemeInfo& scheme) {
  print_scheme(scheme);
  if (!scheme.keys.empty()) print_keys_heading();
  std::set<std::string_view> printed;
  print_keys(scheme, printed);
}

void print_groups() {
  for (size_t i = 0; i < kSchemeGroups; ++i) {
    const auto group = static_cast<SchemeGroup>(i);
    bool heading = false;
    for (const SchemeInfo& scheme : scheme_registry()) {
      if (scheme.group != group) continue;
      if (!heading) std::printf("%s%s: %s\n", i == 0 ? "" : "\n", name_of(group), meaning_of(group));
      heading = true;
      print_scheme(scheme);
    }
  }
}

void print_text() {
  print_groups();
  print_keys_heading();
  std::set<std::string_view> printed;  // schemes of a family share keys
  for (const SchemeInfo& scheme : scheme_registry()) print_keys(scheme, printed);
  std::printf(
      "\nWrite a scheme as name:key=value,key=value, for example -s vdcp:fvc=128,policy=2lfc.\n"
      "A value may be a list {a,b}. A range {A..B} doubles for fvc, ways and entries, and counts by one for\n"
      "sample and period: -s 'vdcp:fvc={16..512}'\n");
}

void print_presets() {
  std::printf("DRAM presets (--dram):\n");
  for (const DramPreset& preset : kDramPresets)
    std::printf("  %-9s %s\n", preset.name.data(), dram_text(preset).c_str());
}

/// A width or rate that the source does not state is null.
void print_presets_json() {
  const auto known = [](uint32_t number) {
    return number != 0 ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const DramPreset& preset : kDramPresets)
    list.push_back({{"name", preset.name},
                    {"burst_bits", preset.burst_bits},
                    {"width_bits", known(preset.width_bits)},
                    {"transfers_mt_s", known(preset.transfers_mt_s)},
                    {"source", preset.source}});
  std::printf("%s\n", list.dump(2).c_str());
}

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress schemes\n"
    "  tilepress schemes vdcp\n"
    "  tilepress schemes --json\n"
    "  tilepress schemes --dram\n";

}  // namespace

int verb_schemes(int argc, char** argv) {
  CLI::App app("Lists the schemes, their sources and their keys.");
  app.footer(kExamples);
  bool json = false, dram = false;
  std::string name;
  RunOptions run;
  app.add_option("SCHEME", name, "Print this scheme and its keys alone");
  add_run_option(app, run, "plugin", "Also list the schemes of this shared library; repeat for more");
  app.add_flag("--json", json, "Print JSON");
  app.add_flag("--dram", dram, "Print the DRAM presets instead: burst, width, data rate and source");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (!name.empty()) {
    const auto spec = parse_scheme(name);
    if (!spec) return fail(kExitUsage, spec.error());
    const SchemeInfo& scheme = *find_scheme(spec->name);
    json ? print_json(&scheme) : print_one(scheme);
    return kExitDone;
  }
  if (json) {
    dram ? print_presets_json() : print_json(nullptr);
    return kExitDone;
  }
  if (!dram) {
    print_text();
    std::printf("\n");
  }
  print_presets();
  return kExitDone;
}

}  // namespace tilepress
