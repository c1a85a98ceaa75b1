// Study commands: status, retry, merge and cache.
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "capture/output_folder.h"
#include "command_line.h"
#include "study/cache/cache_commands.h"
#include "study/invocation.h"
#include "study/study_command.h"
#include "study/task_state.h"
#include "study/task_status.h"

namespace tilepress {
namespace {

/// A study folder that was made before, and its plan.
struct KnownStudy {
  StudyCommand command;
  StudyPlan plan;
};

/// Parses the words after "study NAME". Returns the exit status if the command must stop.
std::optional<int> parse_sub_command(CLI::App& app, int argc, char** argv) {
  std::string name = std::string("study ") + argv[0];
  std::vector<char*> words(argv, argv + argc);
  words[0] = name.data();
  return parse_command_line(app, argc, words.data());
}

/// Parses DIR and, with `works`, the options of work. Returns the exit status if the command must stop.
std::optional<int> open_study(int argc, char** argv, const std::string& about_command, bool works,
                              KnownStudy& known) {
  std::string folder;
  StudyCommand& command = known.command;
  CLI::App app(about_command);
  app.add_option("DIR", folder, "Folder of a study")->required();
  if (works)
    add_work_options(app, command);
  else
    app.add_flag("-q,--quiet", command.quiet, "Print no summary");
  if (const auto status = parse_sub_command(app, argc, argv)) return status;
  if (command.verbose) set_message_level("info");
  auto options = load_invocation(absolute_folder(folder));
  if (!options) return fail(kExitFailed, options.error());
  options->jobs = command.study.jobs;
  options->shard = command.study.shard;
  command.study = std::move(*options);
  auto plan = make_plan(command.study);
  if (!plan) return fail(kExitFailed, plan.error());
  known.plan = std::move(*plan);
  if (!known.plan.workloads.empty()) return std::nullopt;
  say_faults(known.plan);
  return fail(kExitFailed, "no input can be used");
}

}  // namespace

int study_status(int argc, char** argv) {
  KnownStudy known;
  const auto stop = open_study(argc, argv, "Prints which tasks of a study are done, run, failed or never ran.", false, known);
  if (stop) return *stop;
  const auto statuses = task_statuses(known.plan, known.command.study);
  std::fputs(status_text(known.plan, statuses).c_str(), stdout);
  const bool failed = std::ranges::count(statuses, TaskState::kFailed, &TaskStatus::state) > 0;
  return failed ? kExitFailed : kExitDone;
}

int study_retry(int argc, char** argv) {
  KnownStudy known;
  const auto stop = open_study(argc, argv, "Runs the tasks of a study that failed or never ran.", true, known);
  if (stop) return *stop;
  const auto statuses = task_statuses(known.plan, known.command.study);
  for (size_t i = 0; i < statuses.size(); ++i)
    if (statuses[i].state == TaskState::kFailed && known.command.study.shard.takes(i)) {
      const StudyTask& task = *statuses[i].task;
      forget_task(known.command.study.folder, task.id);
      forget_task(known.command.study.folder, rendering_lock(known.plan.workloads[task.workload].name));
    }
  say_faults(known.plan);
  return execute_study(known.plan, known.command);
}

int study_merge(int argc, char** argv) {
  KnownStudy known;
  const auto stop = open_study(argc, argv, "Writes tables and figures of the results that a study folder has.", false, known);
  if (stop) return *stop;
  say_faults(known.plan);
  const auto statuses = task_statuses(known.plan, known.command.study);
  const auto done = std::ranges::count(statuses, TaskState::kDone, &TaskStatus::state);
  const int written = write_outcome(known.plan, known.command.study, known.command.quiet);
  if (written != kExitDone || static_cast<size_t>(done) == statuses.size()) return written;
  return fail(kExitFailed, fmt::format("{} of {} tasks are not done (see `tilepress study status {}`)",
                                       statuses.size() - static_cast<size_t>(done), statuses.size(),
                                       known.command.study.folder));
}

int study_cache(int argc, char** argv) {
  std::string command, folder;
  uint64_t keep_gib = 0;
  PruneOptions prune;
  CLI::App app("Lists or removes rendered traces.");
  app.add_option("COMMAND", command, "list, or prune")->required()->check(CLI::IsMember({"list", "prune"}));
  app.add_option("--cache", folder, "Folder of rendered traces (default: $XDG_CACHE_HOME/tilepress/frames)")
      ->type_name("DIR");
  app.add_option("--keep", keep_gib, "GiB that prune leaves, the most recently used first (default: 0)")
      ->type_name("GIB");
  app.add_flag("-n,--dry-run", prune.dry_run, "Print what prune would remove");
  if (const auto status = parse_sub_command(app, argc, argv)) return *status;
  if (command == "list") return list_cache(folder);
  prune.keep_bytes = keep_gib << 30;
  return prune_cache(folder, prune);
}

}  // namespace tilepress
