// Cost tables: the hardware of DCP and the energy that it saves.
#include <fmt/format.h>

#include <cmath>

#include "report/published_means.h"
#include "report/scheme_names.h"
#include "study/figures/study_tables.h"
#include "tilepress/cost_model.h"

namespace tilepress {
namespace {

constexpr uint32_t kColorBits = 32, kSurfaces = 16;
constexpr uint64_t kFourKPixels = 4096 * 4096;

struct Structure {
  const char* name;
  const char* type;
  StructureFigures CostConstants::*figures;
  uint64_t storage_bits;
};

double published_saving(const std::string& category, const std::string& configuration) {
  for (const PublishedSaving& figure : kPublishedSavings)
    if (configuration == figure.scheme && same_category(figure.category, category)) return figure.saving;
  return NAN;
}

}  // namespace

DocumentTable hardware_table(const StudyData&) {
  const CostConstants constants;
  const uint64_t ccd_bits = ccd_storage_bits(constants.table_entries, kColorBits);
  const Structure structures[] = {{"FVC", "CAM", &CostConstants::fvc,
                                   fvc_storage_bits(constants.table_entries, kColorBits, kFourKPixels)},
                                  {"CCD", "CAM", &CostConstants::ccd, ccd_bits},
                                  {"rCCD", "cache", &CostConstants::rccd, ccd_bits}};
  DocumentTable table{.name = "hardware-cost", .caption = "Cost of DCP's structures, 64 entries"};
  table.header = {"structure",          "type",         "area (mm²)",           "leakage (mW)",
                  "access energy (pJ)", "latency (ns)", "bandwidth (MPixel/s)", "storage (bytes)"};
  table.text_columns = 2;
  for (const Structure& structure : structures) {
    const StructureFigures& figures = constants.*structure.figures;
    table.rows.push_back({document_text(structure.name), document_text(structure.type),
                          document_exact(figures.area_mm2), document_exact(figures.leakage_mw),
                          document_exact(figures.access_pj), document_exact(figures.latency_ns),
                          document_exact(figures.mpixels_per_s),
                          document_exact(static_cast<double>(structure.storage_bits) / 8)});
  }
  table.note = fmt::format(
      "The paper's figures from CACTI 7.0 at 22 nm are the constants of the cost model. Storage follows from "
      "the entries: an "
      "FVC for 4096×4096 pixels. One FVC, one CCD and {} rCCDs take {:.9f} mm².",
      kSurfaces, structures_area_mm2(constants.table_entries, kSurfaces));
  return table;
}

DocumentTable energy_table(const StudyData& data) {
  const CostConstants constants;
  const SurfaceLoad display{.width = 720, .height = 1280};
  const double raw_mw = dram_power_mw(display.raw_bytes_per_s());
  DocumentTable table{.name = "energy", .caption = "Energy of framebuffer traffic"};
  table.header = {"category", "configuration", "rate", "saving", "paper", "DRAM and structures (mW)"};
  table.text_columns = 2;
  for (const std::string& category : data.categories())
    for (const std::string& configuration : data.configurations()) {
      const double rate = data.mean(category, configuration, "rate_hmean");
      // The structures' energy holds for 64 entries: axes are left out.
      if (!has_dcp_structures(configuration) || configuration.find(':') != std::string::npos) continue;
      if (!std::isfinite(rate)) continue;
      table.rows.push_back({document_text(category), document_text(configuration), document_number(rate),
                            document_share(energy_saving(rate)),
                            document_share(published_saving(category, configuration)),
                            document_number(compressed_power_mw(display.raw_bytes_per_s(), rate))});
    }
  table.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}: DRAM takes {1} pJ per byte moved, DCP's structures take {0} pJ per raw "
      "byte. For HDCP "
      "the hardware of RAS is not counted. Power: 720×1280 RGBA8 written and read 60 times a second, {2:.1f} "
      "mW uncompressed, "
      "DRAM's dynamic part only.",
      constants.structures_pj_per_byte, constants.dram_pj_per_byte, raw_mw);
  return table;
}

}  // namespace tilepress
