// Study command: runs tasks, then writes tables.
#include "study_command.h"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "capture/shim_launch.h"
#include "command_line.h"
#include "counted.h"
#include "streams/ending_signals.h"
#include "study/cache/cache_key.h"
#include "study/figures/study_outputs.h"
#include "study/slurm.h"
#include "study/study_run.h"
#include "study/study_tables.h"
#include "study/task_status.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

/// "2/8"
std::string set_shard(const std::string& text, Shard& shard) {
  const size_t slash = text.find('/');
  Shard given;
  const bool read = slash != std::string::npos && read_csv(text.substr(0, slash), given.index) &&
                    read_csv(text.substr(slash + 1), given.count);
  if (!read || given.index < 1 || given.index > given.count)
    return "--shard " + text + ": must be I/N with I in 1..N";
  shard = given;
  return "";
}

std::string summary_line(const StudyPlan& plan, const StudyCommand& command, const StudyCounts& counts,
                         double seconds) {
  std::string out = fmt::format("study {}: {}, {}", plan.study.name, counted(plan.workloads.size(), "workload"),
                                counted(plan.study.configurations.size(), "configuration"));
  if (!command.study.shard.whole())
    out += fmt::format(", shard {}/{}", command.study.shard.index, command.study.shard.count);
  out += fmt::format("\n  traces:  {} rendered, {} from the cache\n", counts.rendered, counts.from_cache);
  out += fmt::format("  results: {} computed, {} kept; {:.1f} s\n", counts.computed, counts.kept, seconds);
  return out;
}

}  // namespace

void add_work_options(CLI::App& app, StudyCommand& command) {
  command.study.jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("-j,--jobs", command.study.jobs,
                 "Tasks to model at a time (default: the number of processors); the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u));
  app.add_option_function<std::string>(
         "--shard",
         [&command](const std::string& text) {
           if (const std::string fault = set_shard(text, command.study.shard); !fault.empty())
             throw CLI::ValidationError(fault);
         },
         "Run part I of N of the tasks; `study merge` writes the tables when all parts are done")
      ->type_name("I/N");
  add_choice_option<StudyLauncher>(
      app, "--launcher", command.launcher, {{"local", StudyLauncher::kLocal}, {"slurm", StudyLauncher::kSlurm}},
      "Run the tasks here, or submit them to Slurm as an array job (default: local)");
  add_progress_option(app, command.progress);
  app.add_flag("-v,--verbose", command.verbose, "Explain each step");
  app.add_flag("-q,--quiet", command.quiet, "Print no progress and no summary");
}

void say_faults(const StudyPlan& plan) {
  for (const Error& fault : plan.faults) fail(kExitFailed, fault);
}

int write_outcome(const StudyPlan& plan, const StudyOptions& options, bool quiet) {
  if (const auto tables = write_study_tables(plan, options); !tables) return fail(kExitFailed, tables.error());
  const auto lines = write_study_outputs(options.folder);
  if (!lines) return fail(kExitFailed, lines.error());
  for (const std::string& line : *lines) say(MessageLevel::kWarning, line);
  if (!quiet) show("  tables:  " + options.folder + "/results.csv, means.csv, workloads.csv\n");
  return kExitDone;
}

int submit_study(const StudyPlan& plan, const StudyCommand& command) {
  std::vector<size_t> tasks;
  const auto statuses = task_statuses(plan, command.study);
  for (size_t i = 0; i < statuses.size(); ++i)
    if (statuses[i].state != TaskState::kDone && statuses[i].state != TaskState::kRunning) tasks.push_back(i);
  if (tasks.empty()) return write_outcome(plan, command.study, command.quiet);
  const auto job = submit_to_slurm(plan, command.study, tasks);
  if (!job) return fail(kExitFailed, job.error());
  if (!command.quiet)
    show(fmt::format("study {}: {} submitted as array job {}; `tilepress study status {}` shows how far it is\n",
                     plan.study.name, counted(tasks.size(), "task"), *job, command.study.folder));
  return plan.faults.empty() ? kExitDone : kExitFailed;
}

int execute_study(const StudyPlan& plan, StudyCommand& command) {
  if (command.launcher == StudyLauncher::kSlurm) return submit_study(plan, command);
  const auto begin = std::chrono::steady_clock::now();
  TemporaryFolder links;
  if (std::ranges::count(plan.workloads, WorkloadKind::kTrace, &Workload::kind) > 0) {
    const auto shim = preloadable_shim(false, links);
    if (!shim) return fail(kExitFailed, shim.error());
    command.study.render.shim = *shim;
    probe_renderer();
  }
  StudyCounts counts;
  {
    ProgressLine progress(command.quiet ? ProgressMode::kNever : command.progress, "study");
    const StudyProgress shown = [&](uint64_t done, std::optional<uint64_t> total) {
      progress.show(done, total);
    };
    counts = run_study(plan, command.study, noted_signal(), progress.is_shown() ? shown : nullptr);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (counts.interrupted)
    return fail(128 + noted_signal(), signal_text(noted_signal()) + ": " + counted(counts.computed, "result") +
                                          " computed; call again to go on");
  if (!command.quiet) show(summary_line(plan, command, counts, seconds));
  if (counts.elsewhere > 0)
    say(MessageLevel::kWarning, counted(counts.elsewhere, "task") +
                                    " run in another process; `tilepress study merge` writes their results later");
  const bool failed = counts.failed > 0 || !plan.faults.empty();
  if (!command.study.shard.whole()) return failed ? kExitFailed : kExitDone;
  const int written = write_outcome(plan, command.study, command.quiet);
  return written == kExitDone && failed ? kExitFailed : written;
}

}  // namespace tilepress
