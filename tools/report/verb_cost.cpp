// tilepress cost: the cost of the DCP structures, and the energy that a rate saves.
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "common_options.h"
#include "tilepress/cost_model.h"
#include "tilepress/scheme.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress cost --size 1920x1080 --rate 5.26 --rate 1.75\n"
    "  tilepress cost --fvc 128 --surfaces 4 --size 3840x2160 --refresh 120 --json\n"
    "  tilepress cost --size 720x1280 --rate 4 --structures-pj 10\n"
    "\n"
    "The constants are the paper's: CACTI 7.0 at 22 nm for 64 entries, DRAMPower 4.0 for LPDDR3.\n";

struct CostOptions {
  uint32_t entries = 64;
  uint32_t surfaces = 16;
  uint32_t sample = 1;
  SurfaceLoad load;
  std::vector<double> rates;
  CostConstants constants;
  bool json = false;

  bool has_table_entries() const { return entries == constants.table_entries; }
  /// The energy of the structures is the paper's, which holds for other entries.
  bool energy_is_of_table() const {
    return !has_table_entries() && constants.structures_pj_per_byte == CostConstants{}.structures_pj_per_byte;
  }
};

double bytes_of(uint64_t bits) {
  return static_cast<double>(bits) / 8;
}

/// The names of the schemes with or without DCP's structures.
std::string scheme_names_by(bool has_structures) {
  std::string out;
  for (const SchemeInfo& scheme : scheme_registry())
    if (scheme.has_dcp_structures == has_structures) out.append(out.empty() ? "" : ", ").append(scheme.name);
  return out;
}

nlohmann::ordered_json hardware_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SchemeInfo& scheme : scheme_registry())
    list.push_back({{"name", scheme.name},
                    {"hardware", scheme.has_dcp_structures ? "FVC, CCD and rCCD" : "not known"}});
  return list;
}

struct NamedStructure {
  const char* name;
  const char* type;
  const StructureFigures& figures;
};

/// The rows of the paper's table of hardware cost.
std::array<NamedStructure, 3> structures_of(const CostConstants& constants) {
  return {{{"FVC", "CAM", constants.fvc}, {"CCD", "CAM", constants.ccd}, {"rCCD", "cache", constants.rccd}}};
}

nlohmann::ordered_json structures_json(const CostConstants& constants) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [name, type, figures] : structures_of(constants))
    list.push_back({{"name", name},
                    {"type", type},
                    {"entries", constants.table_entries},
                    {"area_mm2", figures.area_mm2},
                    {"leakage_mw", figures.leakage_mw},
                    {"access_pj", figures.access_pj},
                    {"latency_ns", figures.latency_ns},
                    {"mpixels_per_s", figures.mpixels_per_s}});
  return list;
}

void print_structures(const CostConstants& constants) {
  std::printf("structures, each of %u entries, CACTI 7.0 at 22 nm\n", constants.table_entries);
  std::printf("  %-5s %-5s %12s %12s %10s %10s %9s\n", "", "type", "area mm2", "leakage mW", "access pJ", "latency ns",
              "MPixel/s");
  for (const auto& [name, type, figures] : structures_of(constants))
    std::printf("  %-5s %-5s %12g %12g %10g %10g %9g\n", name, type, figures.area_mm2, figures.leakage_mw,
                figures.access_pj, figures.latency_ns, figures.mpixels_per_s);
}

void print_json(const CostOptions& options) {
  const uint64_t pixels = uint64_t{options.load.width} * options.load.height;
  const BandwidthCheck check = check_bandwidth(options.load, options.sample, options.constants);
  nlohmann::ordered_json rates = nlohmann::ordered_json::array();
  for (const double rate : options.rates)
    rates.push_back(
        {{"rate", rate},
         {"energy_saving", energy_saving(rate, options.constants)},
         {"power_mw", compressed_power_mw(options.load.raw_bytes_per_s(), rate, options.constants)}});
  const nlohmann::ordered_json document = {
      {"fvc_entries", options.entries},
      {"surfaces", options.surfaces},
      {"fvc_bytes", bytes_of(fvc_storage_bits(options.entries, options.load.pixel_bits, pixels))},
      {"ccd_bytes", bytes_of(ccd_storage_bits(options.entries, options.load.pixel_bits))},
      {"rccd_bytes", bytes_of(options.surfaces * ccd_storage_bits(options.entries, options.load.pixel_bits))},
      {"area_mm2", structures_area_mm2(options.entries, options.surfaces, options.constants)},
      {"area_is_extrapolated", !options.has_table_entries()},
      {"energy_is_not_scaled", options.energy_is_of_table()},
      {"mpixels_per_s",
       {{"fvc", {{"needed", check.fvc_needed}, {"offered", options.constants.fvc.mpixels_per_s}}},
        {"ccd", {{"needed", check.ccd_needed}, {"offered", options.constants.ccd.mpixels_per_s}}},
        {"rccd", {{"needed", check.rccd_needed}, {"offered", options.constants.rccd.mpixels_per_s}}}}},
      {"bandwidth_suffices", check.suffices()},
      {"structures", structures_json(options.constants)},
      {"raw_bytes_per_s", options.load.raw_bytes_per_s()},
      {"raw_power_mw", dram_power_mw(options.load.raw_bytes_per_s(), options.constants)},
      {"rates", rates},
      {"schemes", hardware_json()}};
  std::printf("%s\n", document.dump(2).c_str());
}

void print_bandwidth(const char* name, double needed, double offered) {
  std::printf("  %-5s %9.1f MPixel/s needed, %5.0f offered: %s\n", name, needed, offered,
              needed <= offered ? "suffices" : "DOES NOT suffice");
}

void print_text(const CostOptions& options) {
  const SurfaceLoad& load = options.load;
  const CostConstants& constants = options.constants;
  const uint64_t pixels = uint64_t{load.width} * load.height;
  const double ccd_bytes = bytes_of(ccd_storage_bits(options.entries, load.pixel_bits));
  std::printf("storage, %u entries, %ux%u, %u-bit pixels\n", options.entries, load.width, load.height,
              load.pixel_bits);
  std::printf("  FVC   %9.0f bytes\n",
              std::ceil(bytes_of(fvc_storage_bits(options.entries, load.pixel_bits, pixels))));
  std::printf("  CCD   %9.0f bytes\n", std::ceil(ccd_bytes));
  std::printf("  rCCD  %9.0f bytes, one each for %u surfaces\n", std::ceil(options.surfaces * ccd_bytes),
              options.surfaces);
  print_structures(constants);
  const bool extrapolated = !options.has_table_entries();
  std::printf("area of all  %11.9f mm2%s\n", structures_area_mm2(options.entries, options.surfaces, constants),
              extrapolated ? ", a linear extrapolation of the figures for 64 entries" : "");
  std::printf("bandwidth at %g Hz%s\n", load.refresh_hz,
              extrapolated ? ", the structures being as fast as with 64 entries" : "");
  const BandwidthCheck check = check_bandwidth(load, options.sample, constants);
  print_bandwidth("FVC", check.fvc_needed, constants.fvc.mpixels_per_s);
  print_bandwidth("CCD", check.ccd_needed, constants.ccd.mpixels_per_s);
  print_bandwidth("rCCD", check.rccd_needed, constants.rccd.mpixels_per_s);
  const double raw = load.raw_bytes_per_s();
  std::printf("energy, %g pJ per byte moved, %g pJ per raw byte in the structures%s, %g passes per frame\n",
              constants.dram_pj_per_byte, constants.structures_pj_per_byte,
              options.energy_is_of_table() ? " (as with 64 entries: not scaled)" : "", load.passes);
  std::printf("  raw          %9.2f MB/s %9.2f mW\n", raw / 1e6, dram_power_mw(raw, constants));
  for (const double rate : options.rates)
    std::printf("  rate %7.4g %9.2f MB/s %9.2f mW, saves %.1f %%\n", rate, raw / rate / 1e6,
                compressed_power_mw(raw, rate, constants), 100 * energy_saving(rate, constants));
  std::printf("hardware by scheme\n  %s: the structures above; the RAS part of hdcp is not known\n  %s: not known\n",
              scheme_names_by(true).c_str(), scheme_names_by(false).c_str());
  std::printf(
      "The paper prints 199.6 mW of dynamic power, and 629.4 mW including 429.8 mW of static power.\n"
      "199.6 mW is its own display: 720x1280 RGBA8 written and read 60 times a second, 442.37 MB/s x 451.2 pJ/B.\n");
}

}  // namespace

int verb_cost(int argc, char** argv) {
  CLI::App app("Prints storage, area and speed of the DCP structures, and the energy that a rate saves.");
  app.footer(kExamples);
  CostOptions options;
  const auto powers = [](const std::string& text) {
    for (uint32_t n = 2; n <= 1024; n *= 2)
      if (text == std::to_string(n)) return std::string();
    return "must be a power of two from 2 to 1024, not " + text;
  };
  app.add_option("--fvc", options.entries, "Entries of FVC, CCD and rCCD (default: 64)")
      ->type_name("N")
      ->check(powers);
  app.add_option("--surfaces", options.surfaces, "Surfaces read at once, each with an rCCD (default: 16)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app.add_option("--sample", options.sample, "Only every N-th pixel enters the FVC (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 0x7FFFFFFF));
  std::optional<FrameSize> size;
  add_size_option(app, "size", size, "Size of the surface (default: 1920x1080)");
  app.add_option("--pixel-bits", options.load.pixel_bits, "Bits of a pixel, 16 or 32 (default: 32)")
      ->type_name("BITS")
      ->check(CLI::IsMember({16, 32}));
  app.add_option("--refresh", options.load.refresh_hz, "Frames per second (default: 60)")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 1e6));
  app.add_option("--passes", options.load.passes,
                 "How often each pixel moves per frame (default: 2: the GPU writes it, the display reads it)")
      ->type_name("N")
      ->check(CLI::Range(0.001, 1e6));
  app.add_option("--rate", options.rates, "Compression rate, raw / moved; repeat for more")
      ->type_name("R")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->check(CLI::Range(1e-6, 1e9));
  app.add_option("--dram-pj", options.constants.dram_pj_per_byte, "DRAM energy per byte moved, in pJ (default: 451.2)")
      ->type_name("PJ")
      ->check(CLI::Range(1e-6, 1e9));
  app.add_option("--structures-pj", options.constants.structures_pj_per_byte,
                 "Energy of the structures per raw byte, in pJ (default: 4.83)")
      ->type_name("PJ")
      ->check(CLI::Range(0.0, 1e9));
  app.add_flag("--json", options.json, "Print JSON");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (size) {
    options.load.width = size->width;
    options.load.height = size->height;
  }
  options.json ? print_json(options) : print_text(options);
  return kExitDone;
}

}  // namespace tilepress
