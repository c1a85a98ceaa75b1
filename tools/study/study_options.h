// Study options: what a call of `tilepress study` runs, and how.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/cache/cached_rendering.h"
#include "tilepress/run_options.h"

namespace tilepress {

/// One of `count` parts of the tasks. Parts differ in size by one task at most.
struct Shard {
  uint32_t index = 1, count = 1;  ///< index: 1..count
  bool whole() const { return count == 1; }
  bool takes(size_t task) const { return task % count == index - 1; }
};

struct StudyOptions {
  std::string study;                    ///< "paper" or a file
  std::string folder;                   ///< of the study, absolute
  std::vector<std::string> inputs;      ///< paths and patterns; empty: those of the study
  std::string trace_folder;             ///< of the traces that Mesa manifests list; empty: beside the manifest
  std::vector<std::string> categories;  ///< rules "PATTERN=NAME"
  RunOptions run;                       ///< tile, burst, frames and every count; the rest is not used
  RenderOptions render;
  bool bounds = false;  ///< also what general compressors reach
  uint32_t chunk = 42;  ///< configurations of a task, about
  uint32_t jobs = 1;    ///< tasks at a time
  Shard shard;
};

}  // namespace tilepress
