// Study tables: one text per file.
#include "study_tables.h"

#include "study/result_tables.h"
#include "study/study_json.h"
#include "study/text_file.h"
#include "study/workload_tables.h"

namespace tilepress {

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
  return {};
}

}  // namespace tilepress
