// Inputs: the workloads behind the paths and patterns that a user names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/study_file.h"
#include "tilepress/trace_replay.h"

namespace tilepress {

enum class WorkloadKind : uint8_t {
  kTrace,       ///< an apitrace trace, rendered into the frame cache
  kFrameCache,  ///< a frame cache file
  kImages,      ///< a sequence of images, or one movie or animation
  kRun,         ///< a finished run, whose rows are taken as results
};
const char* name_of(WorkloadKind kind);

struct Workload {
  std::string name;  ///< unique in the study; names files
  std::string category;
  WorkloadKind kind = WorkloadKind::kTrace;
  std::vector<std::string> paths;  ///< absolute; images in order, else one
  ReplayInput trace;               ///< of kTrace: checksum and frames of a manifest
};

/// "name,category," as the first fields of a row of CSV.
std::string subject_cells(const Workload& workload);

struct FoundWorkloads {
  std::vector<Workload> list;
  std::vector<Error> faults;  ///< inputs that give no workload; the path first
};

/// Takes traces, manifests (.toml; .yml and .yaml of Mesa, with traces in `trace_folder`), frame caches, movies,
/// images, finished runs, folders of all these, and patterns of paths. Images of one folder are one workload, in
/// the order given or by name. The content of a file decides what it is. Equal names get "-2", "-3", … in the
/// order of the inputs.
FoundWorkloads find_workloads(const std::vector<std::string>& inputs,
                              const std::string& trace_folder = "");

/// Puts each workload into a category: that of the first rule "PATTERN=NAME" that matches its name, else its
/// own, else that of the first category of the study that names it, else "other". Adds categories that the
/// study does not list to it, and a remark for each listed category and each rule without a workload.
void apply_categories(const std::vector<std::string>& rules, StudyFile& study,
                      std::vector<Workload>& workloads);

}  // namespace tilepress
