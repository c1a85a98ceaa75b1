// Study command: options that `tilepress study` and its sub-commands share, and how a study runs and ends.
#pragma once

#include <CLI/App.hpp>

#include "progress_line.h"
#include "study/study_options.h"
#include "study/study_plan.h"

namespace tilepress {

/// Where tasks run.
enum class StudyLauncher : uint8_t { kLocal, kSlurm };

struct StudyCommand {
  StudyOptions study;
  StudyLauncher launcher = StudyLauncher::kLocal;
  ProgressMode progress = ProgressMode::kAuto;
  bool verbose = false, quiet = false;
};

/// Adds -j, --shard, --launcher, --progress, -v and -q: how this process works on a study.
void add_work_options(CLI::App& app, StudyCommand& command);

/// Runs the tasks of the shard, and writes the tables unless there are other shards. With Slurm, submits the
/// tasks that are not done. Returns the exit status.
int execute_study(const StudyPlan& plan, StudyCommand& command);

/// Writes tables, figures and pages. Returns the exit status.
int write_outcome(const StudyPlan& plan, const StudyOptions& options, bool quiet);

/// Says which inputs give no workload.
void say_faults(const StudyPlan& plan);

// Sub-commands: argv[0] is the sub-command's name.
int study_status(int argc, char** argv);
int study_retry(int argc, char** argv);
int study_merge(int argc, char** argv);
int study_cache(int argc, char** argv);

}  // namespace tilepress
