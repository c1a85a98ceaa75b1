// tilepress compare: two runs or batches side by side, and an exit status for regressions.
#include <fmt/format.h>

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

struct RunPairs {
  std::vector<std::pair<BatchEntry, BatchEntry>> pairs;
  std::vector<std::string> unpaired;  ///< one line per run without a partner
};

/// Pairs the only run of each side, or runs of the same name.
RunPairs pair_runs(const std::vector<BatchEntry>& a, const std::vector<BatchEntry>& b) {
  RunPairs out;
  if (a.size() == 1 && b.size() == 1) {
    out.pairs.emplace_back(a[0], b[0]);
    return out;
  }
  std::map<std::string, const BatchEntry*> by_name;
  for (const BatchEntry& entry : b) by_name[entry.name] = &entry;
  for (const BatchEntry& entry : a) {
    const auto partner = by_name.find(entry.name);
    if (partner == by_name.end()) {
      out.unpaired.push_back(entry.path + ": B has no run of this name");
      continue;
    }
    out.pairs.emplace_back(entry, *partner->second);
    by_name.erase(partner);
  }
  for (const auto& [name, entry] : by_name) out.unpaired.push_back(entry->path + ": A has no run of this name");
  return out;
}

/// Reports each rate that fell by more than the threshold. Returns the number of such rates.
size_t report_regressions(const std::vector<RunComparison>& runs, double threshold_percent) {
  size_t count = 0;
  for (const RunComparison& run : runs)
    for (const SchemeComparison& scheme : run.schemes) {
      const double change = relative_change(scheme.a.rate(), scheme.b.rate());
      if (std::isnan(change) || change * 100 >= -threshold_percent) continue;
      ++count;
      say(MessageLevel::kError,
          fmt::format("{}: rate of {} fell by {:.3g} % ({:.6g} to {:.6g}), more than {:g} %", run.name,
                      scheme.scheme, -change * 100, scheme.a.rate(), scheme.b.rate(), threshold_percent));
    }
  return count;
}

}  // namespace

int verb_compare(int argc, char** argv) {
  CompareOptions options;
  CLI::App app{
      "Compares the rates of two runs, or of two folders of runs, over the frames that both have. Change is "
      "(B - A) / A."};
  app.add_option("A", options.a, "Run directory, or folder of runs: the reference")->required();
  app.add_option("B", options.b, "Run directory, or folder of runs, to compare with A")->required();
  app.add_option("--threshold", options.threshold_percent,
                 "Exit 1 if a scheme's rate falls by more than this many percent")
      ->type_name("PCT")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--format", options.format, "text, markdown or csv (default: text)")
      ->type_name("FORMAT")
      ->check([](const std::string& name) {
        return kFormats.count(name) > 0 ? "" : "must be text, markdown or csv, not '" + name + "'";
      });
  app.add_flag("--per-frame", options.per_frame, "Print a line for every frame and scheme");
  add_frames_option(app, options.frames);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  const ComparisonFormat format = kFormats.at(options.format);
  const auto entries_a = find_runs({options.a});
  if (!entries_a) return fail(kExitFailed, entries_a.error());
  const auto entries_b = find_runs({options.b});
  if (!entries_b) return fail(kExitFailed, entries_b.error());
  const RunPairs found = pair_runs(*entries_a, *entries_b);
  for (const std::string& line : found.unpaired) say(MessageLevel::kError, line);
  if (found.pairs.empty()) return fail(kExitFailed, options.a + ": has no run in common with " + options.b);

  std::vector<RunComparison> runs;
  bool compared_any = false;
  for (const auto& [a, b] : found.pairs) {
    const auto record_a = read_run(a.path), record_b = read_run(b.path);
    if (!record_a || !record_b) return fail(kExitFailed, (record_a ? record_b : record_a).error());
    RunComparison run = compare_runs(*record_a, *record_b, options.frames);
    run.name = a.name;
    // Text and Markdown contain the remarks.
    if (format == ComparisonFormat::kCsv)
      for (const std::string& remark : comparison_remarks(run))
        say(MessageLevel::kError, run.name + ": " + remark);
    if (run.common > 0 && !run.schemes.empty()) compared_any = true;
    runs.push_back(std::move(run));
  }
  std::fputs(comparison_text(runs, format, options.per_frame).c_str(), stdout);
  if (!compared_any) return fail(kExitFailed, "no frame and scheme in common");
  if (!options.threshold_percent) return kExitDone;
  const size_t regressions = report_regressions(runs, *options.threshold_percent);
  // A run or scheme that B lacks may be worse.
  bool gap = !found.unpaired.empty();
  for (const RunComparison& run : runs) gap = gap || run.common == 0 || !run.schemes_only_a.empty();
  return regressions > 0 || gap ? kExitFailed : kExitDone;
}

}  // namespace tilepress
