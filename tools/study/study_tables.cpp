// Study tables: which file has which table.
#include "study_tables.h"

#include <filesystem>

#include "study/text_file.h"

namespace tilepress {

Result<void> write_study_tables(const StudyPlan& plan, const StudyOptions& options) {
  const auto results = load_study_results(plan, options);
  if (!results) return results.error();
  const auto if_wanted = [&](bool wanted, const auto& make) {
    return wanted ? std::optional(make(plan, *results)) : std::nullopt;
  };
  const bool sensitivity = !plan.study.bursts.empty();
  const std::pair<const char*, std::optional<std::string>> files[] = {
      {"results.csv", results_csv(plan, *results)},
      {"means.csv", means_csv(plan, *results)},
      {"workloads.csv", workloads_csv(plan, *results)},
      {"frame_metrics.csv", frame_metrics_csv(plan, *results)},
      {"color_cdf.csv", color_cdf_csv(plan, *results)},
      {"frame_rates.csv", frame_rates_csv(plan, *results)},
      {"study.json", study_json(plan, options)},
      {"provenance.json", provenance_json(plan, options, *results)},
      {"bounds.csv", if_wanted(options.bounds, bounds_csv)},
      {"bound_means.csv", if_wanted(options.bounds, bound_means_csv)},
      {"sensitivity.csv", if_wanted(sensitivity, sensitivity_csv)}};
  for (const auto& [name, text] : files) {
    const std::string path = options.folder + "/" + name;
    std::error_code code;
    // Tables of an earlier call that this one does not want are removed: figures show what the tables hold.
    if (!text) std::filesystem::remove(path, code);
    if (text)
      if (const auto stored = store_text_file(path, *text); !stored) return stored;
  }
  return {};
}

}  // namespace tilepress
