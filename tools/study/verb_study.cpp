// tilepress study: every configuration of a study on every workload, as tables and figures.
#include <cstring>

#include "capture/output_folder.h"
#include "capture/replay_choices.h"
#include "command_line.h"
#include "common_options.h"
#include "report/category_rules.h"
#include "study/invocation.h"
#include "study/plan_text.h"
#include "study/study_command.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Further commands:\n"
    "  study status DIR     print which tasks are done, run, failed or never ran\n"
    "  study retry DIR      run what failed or never ran\n"
    "  study merge DIR      write tables and figures of the results that are there\n"
    "  study cache list     list rendered traces; study cache prune removes them\n"
    "\n"
    "Examples:\n"
    "  tilepress study paper -o out traces/*.trace\n"
    "  tilepress study paper -o out -n traces/                  the plan, without running anything\n"
    "  tilepress study sensitivity -o out traces/               every scheme at DRAM bursts of 128 and 256 bits\n"
    "  tilepress study --example > mine.toml                    a study file to edit\n"
    "  tilepress study mine.toml -o out --category 'game*=3D' shots/ old-run/\n"
    "  tilepress study paper -o out --bounds traces/            grey lines: how far from possible schemes are\n"
    "  tilepress study paper -o out --launcher slurm traces/    one array job\n"
    "\n"
    "Inputs: traces, manifests, frame caches, images, movies, finished runs, and folders or quoted patterns of\n"
    "these. The images of one folder are one workload. DIR keeps every result: a call with another axis, --tile\n"
    "or --burst computes only what is new, and renders nothing again.\n"
    "Exit status: 1 if an input or a task failed; the results of the others are there.\n";

struct VerbOptions {
  StudyCommand command;
  std::vector<std::string> manifests;
  bool plan_only = false, example = false;
};

struct SubCommand {
  const char* name;
  int (*run)(int argc, char** argv);
};
constexpr SubCommand kSubCommands[] = {
    {"status", study_status}, {"retry", study_retry}, {"merge", study_merge}, {"cache", study_cache}};

void add_study_options(CLI::App& app, VerbOptions& options) {
  StudyOptions& study = options.command.study;
  study.run.output = "tilepress-study";
  app.add_option("STUDY", study.study, "paper, sensitivity, or a study file");
  app.add_option("INPUT", study.inputs, "Inputs (default: those of the study file)")->type_name("...");
  app.add_option("--manifest", options.manifests, "A further input: list of traces, TOML or Mesa's traces-*.yml")
      ->type_name("FILE");
  app.add_option("--trace-folder", study.trace_folder,
                 "Folder of the traces that Mesa's manifests list (default: that of the manifest)")
      ->type_name("DIR");
  add_run_option(app, study.run, "output", "Folder of the study (default: " + study.run.output + ")");
  app.add_flag("-n,--plan", options.plan_only, "Print tasks, frames and the estimated time, and run nothing");
  app.add_flag("--example", options.example, "Print a commented study file");
  add_run_option(app, study.run, "plugin", "Shared library with further schemes, beside those of the study's `plugins`; repeat for more");
  add_category_option(app, study.categories);
  add_frame_options(app, study.run);
  app.add_flag("--bounds", study.bounds,
               "Also compute what LZ4, zstd and WebP lossless reach on the same frames: bounds.csv, bound_means.csv "
               "and grey lines in the figures of rates. Frames without 8-bit channels have no bounds");
  app.add_option("--cache", study.render.cache_folder,
                 "Folder of rendered traces (default: $XDG_CACHE_HOME/tilepress/frames)")
      ->type_name("DIR");
  app.add_option_function<uint64_t>(
         "--cache-size", [&study](uint64_t gib) { study.render.size_limit_bytes = gib << 30; },
         "GiB of the cache; the least recently used traces go first (default: 20)")
      ->type_name("GIB")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 20));
  add_replay_choices(app, study.render.retracer, study.render.display, study.render.timeout);
  app.add_option("--chunk", study.chunk,
                 "Configurations of a task, about (default: " + std::to_string(study.chunk) + ")")
      ->type_name("N")
      ->check(CLI::Range(1u, 10000u));
  add_work_options(app, options.command);
}

std::optional<int> parse_options(int argc, char** argv, VerbOptions& options) {
  CLI::App app("Models every configuration of a study on every workload, and writes tables and figures.");
  app.footer(kExamples);
  add_study_options(app, options);
  if (const auto status = parse_command_line(app, argc, argv)) return status;
  StudyOptions& study = options.command.study;
  if (!options.example && study.study.empty())
    return fail(kExitUsage, "no study given: paper, sensitivity, or a study file (see tilepress study --help)");
  study.inputs.insert(study.inputs.end(), options.manifests.begin(), options.manifests.end());
  if (!study.trace_folder.empty()) study.trace_folder = absolute_folder(study.trace_folder);
  study.folder = absolute_folder(study.run.output);
  if (!study.render.cache_folder.empty()) study.render.cache_folder = absolute_folder(study.render.cache_folder);
  if (options.command.verbose) set_message_level("info");
  return std::nullopt;
}

}  // namespace

int verb_study(int argc, char** argv) {
  for (const SubCommand& command : kSubCommands)
    if (argc > 1 && std::strcmp(argv[1], command.name) == 0) return command.run(argc - 1, argv + 1);
  VerbOptions options;
  if (const auto status = parse_options(argc, argv, options)) return *status;
  if (options.example) {
    std::fwrite(example_study().data(), 1, example_study().size(), stdout);
    return kExitDone;
  }
  StudyOptions& study = options.command.study;
  const auto plan = make_plan(study);
  if (!plan) return fail(plan.error().kind == ErrorKind::kBadValue ? kExitUsage : kExitFailed, plan.error());
  say_faults(*plan);
  for (const std::string& remark : plan->study.remarks) say(MessageLevel::kWarning, remark);
  if (plan->workloads.empty()) return fail(kExitFailed, "no input can be used");
  if (options.plan_only) {
    std::fputs(plan_text(*plan, study).c_str(), stdout);
    return plan->faults.empty() ? kExitDone : kExitFailed;
  }
  if (const auto stored = store_invocation(study, plan->study.text); !stored) return fail(kExitFailed, stored.error());
  return execute_study(*plan, options.command);
}

}  // namespace tilepress
