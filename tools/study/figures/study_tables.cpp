// Study tables: what was run.
#include "study/figures/study_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "report/scheme_names.h"

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

}  // namespace

DocumentTable baseline_table(const StudyData& data) {
  DocumentTable table{.name = "baseline", .caption = "Baseline configuration"};
  table.header = {"setting", "this study", "paper"};
  table.text_columns = 3;
  const std::string& base = data.spec.baseline;
  const auto entries = key_of(data, base, "fvc");
  const auto sample = key_of(data, base, "sample");
  const std::pair<const char*, std::pair<std::string, const char*>> rows[] = {
      {"baseline", {base, "DCP"}},
      {"FVC entries", {entries, "64"}},
      {"FVC associativity", {key_of(data, base, "ways"), "full"}},
      {"FVC replacement policy", {key_of(data, base, "policy"), "least-frequent value"}},
      {"CCD entries", {entries, "64"}},
      {"pixel sampling", {sample.empty() ? "" : "1:" + sample, "1:1"}},
      {"frame sampling period", {key_of(data, base, "period"), "1"}},
      {"block, sub-block", {"8×8, 2×2", "8×8, 2×2"}},
      {"CSB bits per sub-block",
       {"1 (DCP, ADCP, HuffDCP), 3 (VDCP), 5 (HDCP)", "1 (DCP, ADCP, HuffDCP), 3 (VDCP), 5 (HDCP)"}},
      {"memory burst", {option_of(data, "burst") + " bits", "128 bits"}},
      {"render tile", {option_of(data, "tile") + " pixels", "not stated"}}};
  for (const auto& [setting, values] : rows)
    table.rows.push_back({document_text(setting), document_text(values.first), document_text(values.second)});
  return table;
}

DocumentTable configurations_table(const StudyData& data) {
  DocumentTable table{.name = "configurations", .caption = "Configurations and their harmonic means"};
  table.header = {"configuration", "scheme"};
  table.text_columns = 2;
  for (const std::string& category : data.categories()) table.header.push_back("rate, " + category);
  for (const std::string& category : data.categories()) table.header.push_back("without bursts, " + category);
  for (const std::string& configuration : data.configurations()) {
    const SchemeInfo* info = scheme_info(configuration);
    auto& row = table.rows.emplace_back();
    row = {document_text(configuration), document_text(info != nullptr ? info->label : "")};
    for (const char* column : {"rate_hmean", "rate_payload_hmean"})
      for (const std::string& category : data.categories())
        row.push_back(document_number(data.mean(category, configuration, column)));
  }
  return table;
}

DocumentTable workloads_table(const StudyData& data) {
  const StudyTable& workloads = data.workloads;
  DocumentTable table{.name = "workloads", .caption = "Workloads"};
  table.header = {"workload", "category", "state",        "frames",        "surfaces",     "surface",
                  "colours",  "entropy",  "pixel change", "colour change", "FVC coverage", "top 100"};
  table.text_columns = 3;
  std::vector<size_t> rows = data.ordered_workloads();
  const std::set<size_t> ordered(rows.begin(), rows.end());
  for (size_t row = 0; row < workloads.row_count(); ++row)
    if (!ordered.contains(row)) rows.push_back(row);
  for (const size_t row : rows) {
    const std::string& reason = workloads.text(row, "reason");
    const std::string& status = workloads.text(row, "status");
    table.rows.push_back(
        {document_text(workloads.text(row, "workload")), document_text(workloads.text(row, "category")),
         document_text(reason.empty() ? status : status + ": " + reason),
         document_text(workloads.text(row, "frames")), document_text(workloads.text(row, "surfaces")),
         document_text(size_of(workloads, row) + " " + workloads.text(row, "format")),
         document_number(workloads.number(row, "unique_colors")),
         document_number(workloads.number(row, "entropy")),
         document_share(workloads.number(row, "pixel_change")),
         document_share(workloads.number(row, "color_change")),
         document_share(workloads.number(row, "fvc_coverage")),
         document_share(workloads.number(row, "top100_coverage"))});
  }
  table.note = "Means over the frames of a workload, without the first frame of each surface.";
  return table;
}

DocumentTable system_table(const StudyData& data) {
  DocumentTable table{.name = "system", .caption = "System and workloads"};
  table.header = {"", "this study", "paper"};
  table.text_columns = 3;
  std::set<std::string> sizes;
  for (const size_t row : data.ordered_workloads())
    if (const std::string size = size_of(data.workloads, row); !size.empty()) sizes.insert(size);
  table.rows.push_back(
      {document_text("operating system"), document_text("–"), document_text("Android 4.2.2 (API 17)")});
  table.rows.push_back({document_text("display size"),
                        document_text(fmt::format("{}", fmt::join(sizes, ", "))), document_text("720×1280")});
  for (const auto& [fact, text] : data.facts)
    table.rows.push_back({document_text(fact), document_text(text), document_text("")});
  for (const std::string& category : data.categories()) {
    size_t count = 0;
    double frames = 0;
    for (const size_t row : data.ordered_workloads()) {
      if (category != kAllCategories && data.workloads.text(row, "category") != category) continue;
      ++count;
      const double own = data.workloads.number(row, "frames");
      frames += std::isnan(own) ? 0 : own;
    }
    std::string published = "";
    for (const PublishedCategory& known : kPublishedCategories)
      if (known.name == category) published = fmt::format("{} ({} frames)", known.workloads, known.frames);
    table.rows.push_back({document_text(data.category_title(category)),
                          document_text(fmt::format("{} ({:.0f} frames)", count, frames)),
                          document_text(published)});
  }
  table.rows.push_back({document_text("tilepress"), document_text(data.spec.version), document_text("")});
  return table;
}

DocumentTable bounds_table(const StudyData& data) {
  DocumentTable table{.name = "bounds", .caption = "Bounds: general compressors on the same frames"};
  table.header = {"category", "bound", "workloads", "rate", "rate without bursts", "smallest rate", "largest rate"};
  table.text_columns = 2;
  const StudyTable& means = data.bound_means;
  for (size_t row = 0; row < means.row_count(); ++row) {
    table.rows.push_back({document_text(data.category_title(means.text(row, "category"))),
                          document_text(means.text(row, "bound")), document_text(means.text(row, "workloads"))});
    for (const char* column : {"rate_hmean", "rate_payload_hmean", "rate_min", "rate_max"})
      table.rows.back().push_back(document_number(means.number(row, column)));
  }
  table.note =
      "Harmonic means. LZ4 and zstd (level 3) compress each 8×8 block alone, or the whole frame; WebP lossless "
      "(level 0) the whole frame. A whole frame has no random access. No status bits are counted.";
  return table;
}

std::vector<DocumentTable> study_tables(const StudyData& data) {
  std::vector<DocumentTable> tables = {baseline_table(data), configurations_table(data)};
  if (data.bound_means.row_count() > 0) tables.push_back(bounds_table(data));
  for (const auto make : {workloads_table, system_table, hardware_table, energy_table}) tables.push_back(make(data));
  return tables;
}

}  // namespace tilepress
