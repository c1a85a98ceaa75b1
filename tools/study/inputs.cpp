// Inputs: patterns first, then folders, then each file by its content.
#include "inputs.h"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "capture/mesa_manifest.h"
#include "capture/trace_manifest.h"
#include "frames/cached_surface.h"
#include "frames/image_folders.h"
#include "images/image_kind.h"
#include "report/category_rules.h"
#include "report/run_batch.h"
#include "tilepress/csv_table.h"
#include "tilepress/run_reader.h"
#include "tilepress/trace_summary.h"
#include "way_out.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKindNames[] = {"trace", "frame cache", "images", "run"};

/// "folder" of folder/, of folder and of folder/..
std::string last_name(const fs::path& path) {
  fs::path full = fs::absolute(path).lexically_normal();
  if (!full.has_filename()) full = full.parent_path();
  return full.filename().string();
}

class WorkloadFinder {
 public:
  explicit WorkloadFinder(std::string trace_folder) : trace_folder_(std::move(trace_folder)) {}
  FoundWorkloads find(const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) add_input(input);
    std::map<std::string, int> uses;
    for (Workload& workload : found_.list) {
      workload.name = plain_file_name(workload.name);
      if (const int use = ++uses[workload.name]; use > 1) workload.name += "-" + std::to_string(use);
    }
    return std::move(found_);
  }

 private:
  void fault(const std::string& path, const std::string& reason) {
    found_.faults.push_back({ErrorKind::kFile, path + ": " + reason});
  }

  void add_input(const std::string& input) {
    std::error_code code;
    if (fs::exists(input, code)) return add_path(input);
    if (input.find_first_of("*?[") == std::string::npos) {
      found_.faults.push_back({ErrorKind::kFile, missing_text(input)});
      return;
    }
    glob_t matches{};
    if (glob(input.c_str(), 0, nullptr, &matches) != 0) fault(input, "matches no file");
    for (size_t i = 0; i < matches.gl_pathc; ++i) add_path(matches.gl_pathv[i]);
    globfree(&matches);
  }

  void add_path(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code))
      add_folder(path);
    else if (path.extension() == ".toml" || is_mesa_manifest(path.string()))
      add_manifest(path.string());
    else if (!add_file(path))
      fault(path.string(), "is no trace, frame cache, image, movie or manifest");
  }

  void add_folder(const fs::path& folder) {
    if (holds_run(folder.string())) return add_run(folder.string());
    std::vector<fs::path> files, folders;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code))
      (entry.is_directory(code) ? folders : files).push_back(entry.path());
    if (code) return fault(folder.string(), code.message());
    std::ranges::sort(files);
    std::ranges::sort(folders);
    const size_t before = found_.list.size();
    for (const fs::path& file : files)
      if (file.filename().string()[0] != '.') add_file(file);
    for (const fs::path& inner : folders)
      if (inner.filename().string()[0] != '.') add_folder(inner);
    if (found_.list.size() == before && folders.empty()) fault(folder.string(), "holds no input");
  }

  void add_run(const std::string& folder) {
    const auto named = find_runs({folder});
    if (named)
      add({named->front().name, "", WorkloadKind::kRun, {folder}, {}});
    else
      found_.faults.push_back(named.error());
  }

  void add_manifest(const std::string& path) {
    const auto listed = read_manifest(path, trace_folder_);
    if (!listed) {
      found_.faults.push_back(listed.error());
      return;
    }
    for (const ReplayInput& input : *listed)
      add({input.name, input.category, WorkloadKind::kTrace, {input.path}, input});
  }

  /// Returns false for a file that is no input.
  bool add_file(const fs::path& file) {
    const std::string path = file.string();
    if (is_frame_cache(path)) {
      add({file.stem().string(), "", WorkloadKind::kFrameCache, {path}, {}});
    } else if (file.extension() == ".trace" || begins_as_trace(path)) {  // a torn trace is a workload that fails
      const std::string name = replay_name(path);
      add({name, "", WorkloadKind::kTrace, {path}, {path, name, "", "", std::nullopt}});
    } else {
      return add_image(file);
    }
    return true;
  }

  bool add_image(const fs::path& file) {
    const ImageReader reader = image_kind_of_file(file.c_str()).reader;
    if (reader == ImageReader::kRefused) return false;
    const bool movie = has_movie_ending(file.string());
    if (reader == ImageReader::kMovie && !movie) return false;
    const bool alone = movie || reader == ImageReader::kGif || reader == ImageReader::kWebp;
    const fs::path folder = file.parent_path();
    if (alone) {
      add({file.stem().string(), "", WorkloadKind::kImages, {file.string()}, {}});
      return true;
    }
    // Images of one folder that follow each other belong together.
    if (!found_.list.empty() && found_.list.back().kind == WorkloadKind::kImages && folder == image_folder_) {
      found_.list.back().paths.push_back(fs::absolute(file).lexically_normal().string());
      return true;
    }
    add({last_name(folder), "", WorkloadKind::kImages, {file.string()}, {}});
    image_folder_ = folder;
    return true;
  }

  void add(Workload workload) {
    image_folder_ = "/dev/null";  // no folder of images
    for (std::string& path : workload.paths) path = fs::absolute(path).lexically_normal().string();
    workload.trace.path = workload.paths[0];
    found_.list.push_back(std::move(workload));
  }

  const std::string trace_folder_;
  FoundWorkloads found_;
  fs::path image_folder_;  ///< of the last workload, if images of this folder may join it
};

std::string category_of(const Workload& workload, const std::vector<std::string>& rules, const StudyFile& study) {
  const std::string ruled = category_by_rules(rules, workload.name, workload.category);
  if (!ruled.empty()) return ruled;
  for (const StudyCategory& category : study.categories)
    for (const std::string& pattern : category.workloads)
      if (fnmatch(pattern.c_str(), workload.name.c_str(), 0) == 0) return category.name;
  return "other";
}

}  // namespace

const char* name_of(WorkloadKind kind) {
  return kKindNames[static_cast<size_t>(kind)];
}

std::string subject_cells(const Workload& workload) {
  return csv_field(workload.name) + "," + csv_field(workload.category) + ",";
}

FoundWorkloads find_workloads(const std::vector<std::string>& inputs, const std::string& trace_folder) {
  return WorkloadFinder(trace_folder).find(inputs);
}

void apply_categories(const std::vector<std::string>& rules, StudyFile& study, std::vector<Workload>& workloads) {
  for (Workload& workload : workloads) {
    if (workload.category.empty() && workload.kind == WorkloadKind::kRun)
      if (const auto run = read_run(workload.paths[0])) workload.category = workload_category(*run);
    workload.category = category_of(workload, rules, study);
    if (std::ranges::count(study.categories, workload.category, &StudyCategory::name) == 0)
      study.categories.push_back({workload.category, workload.category == "other" ? "Other" : workload.category, {}});
  }
  for (const std::string& rule : rules)
    if (std::ranges::all_of(workloads, [&](const Workload& workload) {
          return category_by_rules({rule}, workload.name, "").empty();
        }))
      study.remarks.push_back("--category " + rule + " matches no workload");
  for (const StudyCategory& category : study.categories)
    if (std::ranges::count(workloads, category.name, &Workload::category) == 0)
      study.remarks.push_back("category '" + category.name + "' has no workload");
}

}  // namespace tilepress
