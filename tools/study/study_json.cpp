// Study JSON: members in a fixed order.
#include "study_tables.h"

#include <nlohmann/json.hpp>

#include "study/result_store.h"
#include "tilepress/plugin_library.h"
#include "tilepress/run_option_table.h"

namespace tilepress {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json options_json(const RunOptions& run) {
  Json out = {{"tile", run.model.tile_side}, {"burst", run.model.burst_bits}};
  out["frames"] = run.frames.text();
  out["every"] = run.every;
  for (const PluginLibrary& library : loaded_plugins())
    out["plugins"].push_back({{"path", library.path}, {"digest", library.digest}});
  return out;
}

Json record_json(const Workload& workload, const WorkloadRecord& record) {
  const std::pair<const char*, const std::string*> texts[] = {{"workload", &workload.name},
                                                              {"category", &workload.category},
                                                              {"status", &record.state},
                                                              {"reason", &record.reason},
                                                              {"kind", &record.kind},
                                                              {"source", &record.source},
                                                              {"source_sha256", &record.source_sha256},
                                                              {"frames_sha256", &record.frames_digest},
                                                              {"frames_file", &record.frames_file},
                                                              {"gl_renderer", &record.gl_renderer},
                                                              {"gl_version", &record.gl_version},
                                                              {"retracer", &record.retracer},
                                                              {"rendered", &record.rendered},
                                                              {"prepared", &record.prepared},
                                                              {"host", &record.host},
                                                              {"version", &record.version}};
  Json out = Json::object();
  for (const auto& [name, text] : texts)
    if (!text->empty()) out[name] = *text;
  return out;
}

/// The task that computed a configuration last, by workload and configuration.
Json origin_json(const StudyPlan& plan, const StudyOptions& options, size_t workload, size_t configuration) {
  for (const StudyTask& task : plan.tasks) {
    if (task.workload != workload || std::ranges::count(task.configurations, configuration) == 0) continue;
    const auto record = load_task_record(options.folder, task.id);
    if (!record) break;
    return {{"host", record->host}, {"version", record->version}, {"date", record->date}};
  }
  return Json::object();
}

}  // namespace

std::string study_json(const StudyPlan& plan, const StudyOptions& options) {
  const StudyFile& study = plan.study;
  Json out = {{"name", study.name}, {"title", study.title}, {"options", options_json(options.run)}};
  out["categories"] = Json::array();
  for (const StudyCategory& category : study.categories)
    out["categories"].push_back({{"name", category.name}, {"title", category.title}});
  out["axes"] = Json::array();
  for (const StudyAxis& axis : study.axes)
    out["axes"].push_back({{"name", axis.name},
                           {"title", axis.title},
                           {"scheme", axis.scheme},
                           {"key", axis.key},
                           {"values", axis.values},
                           {"fixed", axis.fixed},
                           {"configurations", axis.configurations}});
  out["baseline"] = study.baseline;
  out["configurations"] = Json::array();
  for (const SchemeSpec& spec : study.configurations) out["configurations"].push_back(spec.text);
  out["figures"] = Json::parse(study.figures_json);
  out["version"] = TILEPRESS_VERSION;
  return dump(out);
}

std::string provenance_json(const StudyPlan& plan, const StudyOptions& options,
                            const std::vector<WorkloadResults>& results) {
  Json out = {{"study", plan.study.name}, {"version", TILEPRESS_VERSION}, {"options", options_json(options.run)}};
  out["workloads"] = Json::array();
  for (size_t workload = 0; workload < results.size(); ++workload) {
    const WorkloadRecord& record = results[workload].record;
    const std::string& name = plan.workloads[workload].name;
    const ResultStore store(options.folder, options.run, name, record.frames_digest);
    Json entry = record_json(plan.workloads[workload], record);
    entry["results"] = Json::array();
    for (size_t i = 0; i < plan.study.configurations.size(); ++i) {
      if (!results[workload].sums[i]) continue;
      const SchemeSpec& spec = plan.study.configurations[i];
      Json result = {{"configuration", spec.text}, {"key", store.result_key(spec)}};
      result["rows"] = store.result_path(spec).substr(options.folder.size() + 1);
      result["computed"] = origin_json(plan, options, workload, i);
      entry["results"].push_back(std::move(result));
    }
    out["workloads"].push_back(std::move(entry));
  }
  return dump(out);
}

}  // namespace tilepress
