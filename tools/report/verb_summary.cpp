// tilepress summary: the rates of finished runs as a table.
#include <cstdio>

#include "capture/replay_tables.h"
#include "command_line.h"
#include "printable.h"
#include "report/category_rules.h"
#include "report/run_batch.h"
#include "verb.h"

namespace tilepress {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress summary out\n"
    "  tilepress summary monday tuesday\n"
    "  tilepress summary out --category 'glmark2*=3D' --category '*=UI'\n";

int verb_summary(int argc, char** argv) {
  std::vector<std::string> paths;
  RunCategories categories;
  CLI::App app{"Prints the rates of finished runs, and their harmonic means by category."};
  app.footer(kExamples);
  app.add_option("DIR", paths, "Run directories, or folders of run directories")->required();
  add_run_category_options(app, categories);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;
  const auto entries = find_runs(paths);
  if (!entries) return fail(kExitFailed, entries.error());
  if (const auto checked = check_category_rules(categories.rules, names_of(*entries)); !checked)
    return fail(kExitUsage, checked.error());
  std::vector<RateRow> rows;
  std::string notes;
  int status = kExitDone;
  for (const BatchEntry& entry : *entries) {
    const auto run = read_run(entry.path);
    if (!run) {
      status = fail(kExitFailed, run.error());
      continue;
    }
    const auto own = rate_rows(*run, entry.name, categories.of(entry.name, workload_category(*run)));
    rows.insert(rows.end(), own.begin(), own.end());
    if (!own.front().is_whole())
      notes += "(!) " + printable(entry.name + ": " + run->state + (run->reason.empty() ? "" : ": " + run->reason)) + "\n";
  }
  std::fputs((rate_table(rows, "run") + notes).c_str(), stdout);
  return status;
}

}  // namespace tilepress
