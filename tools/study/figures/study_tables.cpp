// Study tables: what was run, what it costs and saves.
#include "study/figures/study_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <set>

#include "report/published_means.h"
#include "report/scheme_names.h"
#include "tilepress/cost_model.h"

namespace tilepress {
namespace {

/// What the paper says about its workloads.
struct PublishedCategory {
  std::string_view name;
  const char* workloads;
  const char* frames;
};
constexpr PublishedCategory kPublishedCategories[] = {
    {"UI", "92", "24031"}, {"2D", "20", "7888"}, {"3D", "12", "2549"}, {kAllCategories, "124", "34468"}};

/// The value of an option of study.json; empty if it is not there.
std::string option_of(const StudyData& data, std::string_view name) {
  for (const auto& [known, value] : data.spec.options)
    if (known == name) return value;
  return "";
}

/// The value of a key in the results of a configuration.
std::string key_of(const StudyData& data, const std::string& configuration, const std::string& key) {
  for (size_t row = 0; row < data.results.row_count(); ++row)
    if (data.results.text(row, "configuration") == configuration) return data.key_text(row, key);
  return "";
}

/// A count of pixels per frame such as "720×1280", or "" if the workload has no frames.
std::string size_of(const StudyTable& workloads, size_t row) {
  const std::string& width = workloads.text(row, "width");
  return width.empty() ? "" : width + "×" + workloads.text(row, "height");
}

/// A row of texts.
std::vector<Cell> text_row(std::initializer_list<std::string> texts) {
  std::vector<Cell> row;
  for (const std::string& text : texts) row.push_back(text_cell(text));
  return row;
}

/// The frames of workloads.csv; 0 without any.
double frames_of(const StudyData& data, size_t row) {
  const double frames = data.workloads.number(row, "frames");
  return std::isnan(frames) ? 0 : frames;
}

Table baseline_table(const StudyData& data) {
  Table table{.name = "baseline",
              .caption = "Baseline configuration",
              .header = {"setting", "this study", "paper"},
              .text_columns = 3};
  const std::string& base = data.spec.baseline;
  const auto entries = key_of(data, base, "fvc");
  const auto sample = key_of(data, base, "sample");
  const std::string csb = "1 (DCP, ADCP, HuffDCP), 3 (VDCP), 5 (HDCP)";
  table.rows = {text_row({"baseline", base, "DCP"}),
                text_row({"FVC entries", entries, "64"}),
                text_row({"FVC associativity", key_of(data, base, "ways"), "full"}),
                text_row({"FVC replacement policy", key_of(data, base, "policy"), "least-frequent value"}),
                text_row({"CCD entries", entries, "64"}),
                text_row({"pixel sampling", sample.empty() ? "" : "1:" + sample, "1:1"}),
                text_row({"frame sampling period", key_of(data, base, "period"), "1"}),
                text_row({"block, sub-block", "8×8, 2×2", "8×8, 2×2"}),
                text_row({"CSB bits per sub-block", csb, csb}),
                text_row({"memory burst", option_of(data, "burst") + " bits", "128 bits"}),
                text_row({"render tile", option_of(data, "tile") + " pixels", "not stated"})};
  return table;
}

Table configurations_table(const StudyData& data) {
  Table table{.name = "configurations",
              .caption = "Configurations and their harmonic means",
              .header = {"configuration", "scheme"},
              .text_columns = 2};
  for (const char* value : {"rate, ", "without bursts, "})
    for (const std::string& category : data.categories()) table.header.push_back(value + category);
  for (const std::string& configuration : data.configurations()) {
    const SchemeInfo* info = scheme_info(configuration);
    auto& row = table.rows.emplace_back(text_row({configuration, info != nullptr ? info->label : ""}));
    for (const char* column : {"rate_hmean", "rate_payload_hmean"})
      for (const std::string& category : data.categories())
        row.push_back(number_cell(data.mean(category, configuration, column)));
  }
  return table;
}

Table workloads_table(const StudyData& data) {
  const StudyTable& workloads = data.workloads;
  Table table{.name = "workloads",
              .caption = "Workloads",
              .header = {"workload", "category", "state", "frames", "surfaces", "surface", "colours",
                         "entropy", "pixel change", "colour change", "FVC coverage", "top 100"},
              .text_columns = 3,
              .note = "Means over the frames of a workload, without the first frame of each surface."};
  std::vector<size_t> rows = data.ordered_workloads();
  const std::set<size_t> ordered(rows.begin(), rows.end());
  for (size_t row = 0; row < workloads.row_count(); ++row)
    if (!ordered.contains(row)) rows.push_back(row);
  for (const size_t row : rows) {
    const auto text = [&](const char* column) { return workloads.text(row, column); };
    const std::string reason = text("reason");
    auto& cells = table.rows.emplace_back(
        text_row({text("workload"), text("category"), text("status") + (reason.empty() ? "" : ": " + reason),
                  text("frames"), text("surfaces"), size_of(workloads, row) + " " + text("format")}));
    for (const char* column : {"unique_colors", "entropy"})
      cells.push_back(number_cell(workloads.number(row, column)));
    for (const char* column : {"pixel_change", "color_change", "fvc_coverage", "top100_coverage"})
      cells.push_back(percent_cell(workloads.number(row, column)));
  }
  return table;
}

Table system_table(const StudyData& data) {
  Table table{.name = "system",
              .caption = "System and workloads",
              .header = {"", "this study", "paper"},
              .text_columns = 3};
  std::set<std::string> sizes;
  for (const size_t row : data.ordered_workloads())
    if (const std::string size = size_of(data.workloads, row); !size.empty()) sizes.insert(size);
  table.rows = {text_row({"operating system", "–", "Android 4.2.2 (API 17)"}),
                text_row({"display size", fmt::format("{}", fmt::join(sizes, ", ")), "720×1280"})};
  for (const auto& [fact, text] : data.facts) table.rows.push_back(text_row({fact, text, ""}));
  for (const std::string& category : data.categories()) {
    const std::vector<size_t> workloads = data.workloads_of(category);
    double frames = 0;
    for (const size_t row : workloads) frames += frames_of(data, row);
    std::string published;
    for (const PublishedCategory& known : kPublishedCategories)
      if (known.name == category) published = fmt::format("{} ({} frames)", known.workloads, known.frames);
    table.rows.push_back(text_row({data.category_title(category),
                                   fmt::format("{} ({:.0f} frames)", workloads.size(), frames), published}));
  }
  table.rows.push_back(text_row({"tilepress", data.spec.version, ""}));
  return table;
}

Table bounds_table(const StudyData& data) {
  Table table{
      .name = "bounds",
      .caption = "Bounds: general compressors on the same frames",
      .header = {"category", "bound", "workloads", "rate", "rate without bursts", "smallest rate",
                 "largest rate"},
      .text_columns = 2,
      .note =
          "Harmonic means. LZ4 and zstd (level 3) compress each 8×8 block alone, or the whole frame; WebP "
          "lossless "
          "(level 0) the whole frame. A whole frame has no random access. No status bits are counted."};
  const StudyTable& means = data.bound_means;
  for (size_t row = 0; row < means.row_count(); ++row) {
    auto& cells = table.rows.emplace_back(text_row({data.category_title(means.text(row, "category")),
                                                    means.text(row, "bound"), means.text(row, "workloads")}));
    for (const char* column : {"rate_hmean", "rate_payload_hmean", "rate_min", "rate_max"})
      cells.push_back(number_cell(means.number(row, column)));
  }
  return table;
}

Table hardware_table(const StudyData&) {
  constexpr uint32_t kColorBits = 32, kSurfaces = 16;
  constexpr uint64_t kFourKPixels = 4096 * 4096;
  const CostConstants constants;
  Table table{.name = "hardware-cost",
              .caption = "Cost of DCP's structures, 64 entries",
              .header = {"structure", "type", "area (mm²)", "leakage (mW)", "access energy (pJ)",
                         "latency (ns)", "bandwidth (MPixel/s)", "storage (bytes)"},
              .text_columns = 2};
  const auto add = [&](const char* name, const char* type, const StructureFigures& figures,
                       uint64_t storage_bits) {
    auto& cells = table.rows.emplace_back(text_row({name, type}));
    for (const double figure : {figures.area_mm2, figures.leakage_mw, figures.access_pj, figures.latency_ns,
                                figures.mpixels_per_s, static_cast<double>(storage_bits) / 8})
      cells.push_back(exact_cell(figure));
  };
  const uint64_t ccd_bits = ccd_storage_bits(constants.table_entries, kColorBits);
  add("FVC", "CAM", constants.fvc, fvc_storage_bits(constants.table_entries, kColorBits, kFourKPixels));
  add("CCD", "CAM", constants.ccd, ccd_bits);
  add("rCCD", "cache", constants.rccd, ccd_bits);
  table.note = fmt::format(
      "The paper's figures from CACTI 7.0 at 22 nm are the constants of the cost model. Storage follows from "
      "the "
      "entries: an FVC for 4096×4096 pixels. One FVC, one CCD and {} rCCDs take {:.9f} mm².",
      kSurfaces, structures_area_mm2(constants.table_entries, kSurfaces));
  return table;
}

Table energy_table(const StudyData& data) {
  const CostConstants constants;
  const SurfaceLoad display{.width = 720, .height = 1280};
  Table table{.name = "energy",
              .caption = "Energy of framebuffer traffic",
              .header = {"category", "configuration", "rate", "saving", "paper", "DRAM and structures (mW)"},
              .text_columns = 2};
  for (const std::string& category : data.categories())
    for (const std::string& configuration : data.configurations()) {
      const double rate = data.mean(category, configuration, "rate_hmean");
      // The structures' energy holds for 64 entries: axes are left out.
      if (!has_dcp_structures(configuration) || configuration.find(':') != std::string::npos) continue;
      if (!std::isfinite(rate)) continue;
      table.rows.push_back({text_cell(category), text_cell(configuration), number_cell(rate),
                            percent_cell(energy_saving(rate)),
                            percent_cell(published_saving(configuration, category)),
                            number_cell(compressed_power_mw(display.raw_bytes_per_s(), rate))});
    }
  table.note = fmt::format(
      "saving = 1 − 1/rate − {0}/{1}: DRAM takes {1} pJ per byte moved, DCP's structures take {0} pJ per raw "
      "byte. For "
      "HDCP the hardware of RAS is not counted. Power: 720×1280 RGBA8 written and read 60 times a second, "
      "{2:.1f} mW "
      "uncompressed, DRAM's dynamic part only.",
      constants.structures_pj_per_byte, constants.dram_pj_per_byte, dram_power_mw(display.raw_bytes_per_s()));
  return table;
}

}  // namespace

std::vector<Table> study_tables(const StudyData& data) {
  std::vector<Table> tables = {baseline_table(data), configurations_table(data)};
  if (data.bound_means.row_count() > 0) tables.push_back(bounds_table(data));
  for (const auto make : {workloads_table, system_table, hardware_table, energy_table}) tables.push_back(make(data));
  return tables;
}

}  // namespace tilepress
