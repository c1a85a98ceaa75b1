// Program launch: one run of a program under the shim, and the run folders that its processes left.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "capture/child_process.h"
#include "capture/session_folder.h"
#include "tilepress/run_options.h"
#include "tilepress/shim_environment.h"

namespace tilepress {

struct LaunchOptions {
  RunOptions run;  ///< output: absolute
  ShimRoad via = ShimRoad::kAuto;
  std::string shim;            ///< of preloadable_shim()
  double seconds = 0;          ///< until the program receives SIGTERM; 0 = it ends by itself
  bool capture = true;         ///< false: the shim only counts
  bool present_times = false;  ///< the shim notes when each frame was presented
  bool quiet = false;          ///< no summaries
  std::vector<std::string> program;
  std::vector<std::pair<std::string, std::string>> labels;  ///< string members for each run.json
};

/// Sums over the run folders of a session.
struct Harvest {
  uint64_t captured = 0;
  uint64_t seen = 0;
  uint64_t mismatched_blocks = 0;
  bool failed = false;  ///< a run failed or could not be closed; the messages are written
};

struct Launch {
  ChildEnd child;
  Harvest found;
  std::vector<CapturedProcess> processes;  ///< that left a run folder
};

/// Runs the program once, writes the shim's messages and a summary of each run, and closes the runs. Error:
/// as run_child(); everything else that goes wrong before the program starts is kSystem.
Result<Launch> launch_program(const LaunchOptions& options, SessionFolder& session);

}  // namespace tilepress
