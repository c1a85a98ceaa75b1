// Study data: reads the files and builds the look-ups.
#include "study/figures/study_data.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "report/published_means.h"

namespace tilepress {
namespace {

struct DataFile {
  const char* name;
  StudyTable StudyData::*table;
  bool required;
};
constexpr DataFile kFiles[] = {
    {"results.csv", &StudyData::results, true},
    {"means.csv", &StudyData::means, true},
    {"workloads.csv", &StudyData::workloads, true},
    {"frame_metrics.csv", &StudyData::frame_metrics, false},
    {"color_cdf.csv", &StudyData::color_cdf, false},
    {"frame_rates.csv", &StudyData::frame_rates, false},
    {"bounds.csv", &StudyData::bounds, false},
    {"bound_means.csv", &StudyData::bound_means, false},
    {"sensitivity.csv", &StudyData::sensitivity, false},
};

/// The number in the row of a table of bounds whose first column holds `subject`.
double bound_number(const StudyTable& table, std::string_view subject_column, const std::string& subject,
                    const std::string& bound, std::string_view column) {
  for (size_t row = 0; row < table.row_count(); ++row)
    if (table.text(row, subject_column) == subject && table.text(row, "bound") == bound)
      return table.number(row, column);
  return NAN;
}

}  // namespace

double StudyData::bound(const std::string& workload, const std::string& name, std::string_view column) const {
  return bound_number(bounds, "workload", workload, name, column);
}

double StudyData::bound_mean(const std::string& category, const std::string& name,
                             std::string_view column) const {
  return bound_number(bound_means, "category", category, name, column);
}

double StudyData::number_in(const StudyTable& table, const std::map<Pair, size_t>& rows, const Pair& subject,
                            std::string_view column) {
  const auto found = rows.find(subject);
  return found == rows.end() ? NAN : table.number(found->second, column);
}

std::string StudyData::key_text(size_t row, const std::string& key) const {
  const std::string& text = results.text(row, key);
  // The registry's default: as many ways as the FVC has entries.
  return key == "ways" && text == "fvc" ? "full" : text;
}

double StudyData::result(const std::string& workload, const std::string& configuration,
                         std::string_view column) const {
  return number_in(results, result_rows_, {workload, configuration}, column);
}

double StudyData::mean(const std::string& category, const std::string& configuration,
                       std::string_view column) const {
  return number_in(means, mean_rows_, {category, configuration}, column);
}

std::string StudyData::spelled_category(const std::string& name) const {
  for (const std::string& category : categories_)
    if (same_category(category, name)) return category;
  return name;
}

std::string StudyData::category_title(const std::string& category) const {
  for (const FigureCategory& known : spec.categories)
    if (known.name == category) return known.title;
  if (category == kAllCategories) return "all workloads";
  return category.empty() ? "no category" : category;
}

std::vector<size_t> StudyData::workloads_of(const std::string& category) const {
  std::vector<size_t> rows = ordered_workloads_;
  if (category != kAllCategories)
    std::erase_if(rows, [&](size_t row) { return workloads.text(row, "category") != category; });
  return rows;
}

void StudyData::index() {
  std::set<std::string> known;
  for (size_t row = 0; row < results.row_count(); ++row) {
    const std::string& configuration = results.text(row, "configuration");
    result_rows_[{results.text(row, "workload"), configuration}] = row;
    if (known.insert(configuration).second) configurations_.push_back(configuration);
  }
  index_means();
  order_workloads();
}

void StudyData::index_means() {
  std::set<std::string> known;
  for (size_t row = 0; row < means.row_count(); ++row) {
    const std::string& category = means.text(row, "category");
    mean_rows_[{category, means.text(row, "configuration")}] = row;
    known.insert(category);
  }
  const auto take = [&](const std::string& category) {
    if (category != kAllCategories && known.erase(category) > 0) categories_.push_back(category);
  };
  for (const FigureCategory& category : spec.categories) take(category.name);
  for (size_t row = 0; row < means.row_count(); ++row) take(means.text(row, "category"));
  if (known.contains(kAllCategories)) categories_.push_back(kAllCategories);
}

void StudyData::order_workloads() {
  std::string configuration = configurations_.empty() ? "" : configurations_.front();
  if (std::ranges::count(configurations_, "dcp") > 0) configuration = "dcp";
  std::vector<std::tuple<size_t, double, size_t>> keys;
  for (size_t row = 0; row < workloads.row_count(); ++row) {
    const std::string& category = workloads.text(row, "category");
    const std::string& workload = workloads.text(row, "workload");
    const auto first = result_rows_.lower_bound({workload, ""});
    if (first == result_rows_.end() || first->first.first != workload) continue;
    double rate = result(workload, configuration, "rate_payload");
    if (std::isnan(rate)) rate = INFINITY;
    const auto place = std::find(categories_.begin(), categories_.end(), category);
    keys.emplace_back(static_cast<size_t>(place - categories_.begin()), rate, row);
  }
  std::sort(keys.begin(), keys.end());
  for (const auto& key : keys) ordered_workloads_.push_back(std::get<2>(key));
}

Result<StudyData> read_study_data(const std::string& study_folder) {
  StudyData data;
  auto spec = read_study_spec(study_folder + "/study.json");
  if (!spec) return spec.error();
  data.spec = std::move(*spec);
  data.facts = read_render_facts(study_folder + "/provenance.json");
  for (const DataFile& file : kFiles) {
    const std::string path = study_folder + "/" + file.name;
    if (!file.required && !std::filesystem::exists(path)) continue;
    auto table = StudyTable::read(path);
    if (!table) return table.error();
    data.*file.table = std::move(*table);
  }
  data.index();
  return data;
}

}  // namespace tilepress
