// tilepress compare: two runs or batches side by side, and an exit status for regressions.
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "common_options.h"
#include "report/compare/comparison_text.h"
#include "report/run_batch.h"
#include "verb.h"

namespace tilepress {
namespace {

const std::map<std::string, ComparisonFormat> kFormats = {{"text", ComparisonFormat::kText},
                                                          {"markdown", ComparisonFormat::kMarkdown},
                                                          {"csv", ComparisonFormat::kCsv}};

struct CompareOptions {
  std::string a, b;
  std::optional<double> threshold_percent;
  std::string format = "text";
  bool per_frame = false;
  FrameSet frames;
};

/// Runs of both sides that belong together: the only ones, or those of one name.
bool pair_runs(const std::vector<BatchEntry>& a, const std::vector<BatchEntry>& b,
               std::vector<std::pair<BatchEntry, BatchEntry>>& pairs, std::vector<std::string>& unpaired) {
  if (a.size() == 1 && b.size() == 1) {
    pairs.emplace_back(a[0], b[0]);
    return true;
  }
  std::map<std::string, const BatchEntry*> by_name;
  for (const BatchEntry& entry : b) by_name[entry.name] = &entry;
  for (const BatchEntry& entry : a) {
    const auto partner = by_name.find(entry.name);
    if (partner == by_name.end()) {
      unpaired.push_back(entry.path + ": no run of this name in B");
      continue;
    }
    pairs.emplace_back(entry, *partner->second);
    by_name.erase(partner);
  }
  for (const auto& [name, entry] : by_name) unpaired.push_back(entry->path + ": no run of this name in A");
  return !pairs.empty();
}

/// Prints each rate that fell by more than the threshold. Returns how many did.
size_t tell_regressions(const std::vector<RunComparison>& runs, double threshold_percent) {
  size_t count = 0;
  for (const RunComparison& run : runs)
    for (const SchemeComparison& scheme : run.schemes) {
      const double change = relative_change(scheme.a.rate(), scheme.b.rate());
      if (std::isnan(change) || change * 100 >= -threshold_percent) continue;
      ++count;
      std::fprintf(stderr, "tilepress: %s: rate of %s fell by %.3g %% (%.6g to %.6g), more than %g %%\n",
                   run.name.c_str(), scheme.scheme.c_str(), -change * 100, scheme.a.rate(), scheme.b.rate(),
                   threshold_percent);
    }
  return count;
}

}  // namespace

int verb_compare(int argc, char** argv) {
  CompareOptions options;
  CLI::App app{
      "Compares two runs, or two folders of runs, over the frames that both have. Change is (B - A) / A of "
      "the rate."};
  app.add_option("A", options.a, "Run directory, or folder of runs: the reference")->required();
  app.add_option("B", options.b, "The same, to be compared with A")->required();
  app.add_option("--threshold", options.threshold_percent,
                 "Exit 1 if a scheme's rate falls by more than this many percent")
      ->type_name("PCT")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--format", options.format, "text, markdown or csv (default: text)")
      ->type_name("FORMAT")
      ->check([](const std::string& name) {
        return kFormats.count(name) > 0 ? "" : "must be text, markdown or csv, not '" + name + "'";
      });
  app.add_flag("--per-frame", options.per_frame, "A line for every frame and scheme");
  add_frames_option(app, options.frames);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  const ComparisonFormat format = kFormats.at(options.format);
  std::string error;
  const auto entries_a = find_runs({options.a}, error);
  if (entries_a.empty()) return fail(kExitFailed, error);
  const auto entries_b = find_runs({options.b}, error);
  if (entries_b.empty()) return fail(kExitFailed, error);
  std::vector<std::pair<BatchEntry, BatchEntry>> pairs;
  std::vector<std::string> unpaired;
  const bool paired = pair_runs(entries_a, entries_b, pairs, unpaired);
  for (const std::string& line : unpaired) fail(kExitFailed, line);
  if (!paired) return fail(kExitFailed, options.a + ": has no run in common with " + options.b);

  std::vector<RunComparison> runs;
  bool compared_any = false;
  for (const auto& [a, b] : pairs) {
    const auto record_a = read_run(a.path), record_b = read_run(b.path);
    if (!record_a || !record_b) return fail(kExitFailed, (record_a ? record_b : record_a).error().text);
    RunComparison run = compare_runs(*record_a, *record_b, options.frames);
    run.name = a.name;
    // The other formats have the remarks in their text.
    if (format == ComparisonFormat::kCsv)
      for (const std::string& remark : comparison_remarks(run)) fail(kExitFailed, run.name + ": " + remark);
    if (run.common > 0 && !run.schemes.empty()) compared_any = true;
    runs.push_back(std::move(run));
  }
  std::fputs(comparison_text(runs, format, options.per_frame).c_str(), stdout);
  if (!compared_any) return fail(kExitFailed, "no frame and scheme in common");
  if (!options.threshold_percent) return kExitDone;
  const size_t regressions = tell_regressions(runs, *options.threshold_percent);
  // What one side lacks cannot be shown to be no worse.
  bool gap = !unpaired.empty();
  for (const RunComparison& run : runs) gap = gap || run.common == 0 || !run.schemes_only_a.empty();
  return regressions > 0 || gap ? kExitFailed : kExitDone;
}

}  // namespace tilepress
