// Study tables: one text per file.
#include "study_tables.h"

#include <filesystem>

#include "study/result_tables.h"
#include "study/study_json.h"
#include "study/text_file.h"
#include "study/workload_tables.h"

namespace tilepress {
namespace {

struct OptionalTable {
  const char* name;
  std::string (*make)(const StudyPlan&, const std::vector<WorkloadResults>&);
  bool wanted;
};

/// Tables of an earlier call that this one does not want are removed: figures show what the tables hold.
Result<void> write_optional_tables(const StudyPlan& plan, const StudyOptions& options,
                                   const std::vector<WorkloadResults>& results) {
  const OptionalTable tables[] = {{"bounds.csv", bounds_csv, options.bounds},
                                  {"bound_means.csv", bound_means_csv, options.bounds},
                                  {"sensitivity.csv", sensitivity_csv, !plan.study.bursts.empty()}};
  for (const auto& [name, make, wanted] : tables) {
    const std::string path = options.folder + "/" + name;
    std::error_code code;
    if (!wanted)
      std::filesystem::remove(path, code);
    else if (const auto stored = store_text_file(path, make(plan, results)); !stored)
      return stored;
  }
  return {};
}

}  // namespace

Result<void> write_study_tables(const StudyPlan& plan, const StudyOptions& options) {
  const auto results = load_study_results(plan, options);
  if (!results) return results.error();
  const std::pair<const char*, std::string> files[] = {
      {"results.csv", results_csv(plan, *results)},
      {"means.csv", means_csv(plan, *results)},
      {"workloads.csv", workloads_csv(plan, *results)},
      {"frame_metrics.csv", frame_metrics_csv(plan, *results)},
      {"color_cdf.csv", color_cdf_csv(plan, *results)},
      {"frame_rates.csv", frame_rates_csv(plan, *results)},
      {"study.json", study_json(plan, options)},
      {"provenance.json", provenance_json(plan, options, *results)}};
  for (const auto& [name, text] : files)
    if (const auto stored = store_text_file(options.folder + "/" + name, text); !stored) return stored;
  return write_optional_tables(plan, options, *results);
}

}  // namespace tilepress
