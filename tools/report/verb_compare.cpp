// tilepress compare: two runs or batches side by side, and an exit status for regressions.
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "common_options.h"
#include "report/compare/comparison_text.h"
#include "report/compare/regressions.h"
#include "report/run_batch.h"
#include "streams/output_file.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress compare before after\n"
    "  tilepress compare out --map 'vdcp => vdcp:fvc=128'\n"
    "  tilepress compare before after --threshold 1 --github --junit rates.xml\n"
    "  tilepress compare before after --format markdown --frames 100-199\n";

struct CompareOptions {
  std::string a, b, junit;
  std::vector<SchemePair> map;
  bool github = false;
  std::optional<double> threshold_percent;
  ComparisonFormat format = ComparisonFormat::kText;
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

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

/// "vdcp => vdcp:fvc=128"
SchemePair parse_map(const std::string& text) {
  const size_t arrow = text.find("=>");
  SchemePair pair;
  if (arrow != std::string::npos) pair = {trimmed(text.substr(0, arrow)), trimmed(text.substr(arrow + 2))};
  if (pair.a.empty() || pair.b.empty())
    throw CLI::ValidationError("--map " + text + ": needs 'SCHEME OF A => SCHEME OF B'");
  return pair;
}

/// Fails for a scheme of --map that a run lacks.
Result<void> check_map(const std::vector<SchemePair>& map, const RunRecord& run,
                       std::string SchemePair::*side) {
  const std::vector<std::string>& names = run.scheme_names;
  for (const SchemePair& pair : map)
    if (scheme_position(names, pair.*side) == names.size()) {
      const std::vector<std::string_view> known(names.begin(), names.end());
      return Error{ErrorKind::kBadValue,
                   "--map " + pair.text() + ": " + run.path + " has no scheme '" + pair.*side + "'" +
                       nearest_hint(pair.*side, known, "it has " + listed_words(known, ", "))};
    }
  return {};
}

/// Adds the comparison of each pair to `runs`.
Result<void> compare_pairs(const RunPairs& found, const CompareOptions& options,
                           std::vector<RunComparison>& runs) {
  for (const auto& [a, b] : found.pairs) {
    const auto record_a = read_run(a.path), record_b = read_run(b.path);
    if (!record_a || !record_b) return (record_a ? record_b : record_a).error();
    if (const auto checked = check_map(options.map, *record_a, &SchemePair::a); !checked) return checked;
    if (const auto checked = check_map(options.map, *record_b, &SchemePair::b); !checked) return checked;
    RunComparison run = compare_runs(*record_a, *record_b, options.frames, options.map);
    run.name = a.name;
    runs.push_back(std::move(run));
  }
  return {};
}

/// What CI wants beside the table. Returns the exit status.
int report_checks(const std::vector<RunComparison>& runs, const RunPairs& found,
                  const CompareOptions& options) {
  const auto checks = check_rates(runs, found.unpaired, *options.threshold_percent);
  bool failed = false;
  for (const RateCheck& check : checks) {
    failed = failed || !check.fault.empty();
    // A line for each run without a partner was printed before.
    if (!check.fault.empty() && check.workload != "runs")
      say(MessageLevel::kError, check.workload + ": " + check.fault);
  }
  if (options.github) {
    std::vector<std::string> remarks;
    for (const RunComparison& run : runs)
      for (const std::string& remark : comparison_remarks(run)) remarks.push_back(run.name + ": " + remark);
    std::fputs(github_annotations(checks, remarks).c_str(), stdout);
  }
  if (!options.junit.empty())
    if (const auto written = write_whole_file(options.junit, junit_xml(checks), true); !written)
      return fail(kExitFailed, written.error());
  return failed ? kExitFailed : kExitDone;
}

std::optional<int> parse_options(int argc, char** argv, CompareOptions& options) {
  CLI::App app{
      "Compares the rates of two runs, or of two folders of runs, over the frames that both have. Change is "
      "(B - A) / A."};
  app.footer(kExamples);
  app.add_option("A", options.a, "Run directory, or folder of runs: the reference")->required();
  app.add_option("B", options.b,
                 "Run directory, or folder of runs, to compare with A (with --map: default A)");
  app.add_option_function<std::vector<std::string>>(
         "--map",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.map.push_back(parse_map(text));
         },
         "Compare a scheme of A with another scheme of B, as 'vdcp => vdcp:fvc=128'; repeatable")
      ->type_name("'S => T'")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_option("--threshold", options.threshold_percent,
                 "Exit 1 if a scheme's rate falls by more than this many percent")
      ->type_name("PCT")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--github", options.github,
               "With --threshold: print errors and warnings as annotations of GitHub Actions")
      ->needs("--threshold");
  app.add_option("--junit", options.junit, "With --threshold: write the checks as a JUnit file")
      ->type_name("FILE")
      ->needs("--threshold");
  add_choice_option<ComparisonFormat>(app, "--format", options.format,
                                      {{"text", ComparisonFormat::kText},
                                       {"markdown", ComparisonFormat::kMarkdown},
                                       {"csv", ComparisonFormat::kCsv}},
                                      "Format of the table (default: text)");
  app.add_flag("--per-frame", options.per_frame, "Print a line for every frame and scheme");
  add_frames_option(app, options.frames);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;
  if (options.b.empty() && options.map.empty())
    return fail(kExitUsage, "no B given (see tilepress compare --help)");
  if (options.b.empty()) options.b = options.a;
  return std::nullopt;
}

}  // namespace

int verb_compare(int argc, char** argv) {
  CompareOptions options;
  if (const auto stop = parse_options(argc, argv, options)) return *stop;
  const auto entries_a = find_runs({options.a});
  if (!entries_a) return fail(kExitFailed, entries_a.error());
  const auto entries_b = find_runs({options.b});
  if (!entries_b) return fail(kExitFailed, entries_b.error());
  const RunPairs found = pair_runs(*entries_a, *entries_b);
  for (const std::string& line : found.unpaired) say(MessageLevel::kError, line);
  if (found.pairs.empty()) return fail(kExitFailed, options.a + ": has no run in common with " + options.b);

  std::vector<RunComparison> runs;
  if (const auto compared = compare_pairs(found, options, runs); !compared)
    return fail(compared.error().kind == ErrorKind::kBadValue ? kExitUsage : kExitFailed, compared.error());
  bool compared_any = false;
  for (const RunComparison& run : runs) {
    compared_any = compared_any || (run.common > 0 && !run.schemes.empty());
    // Text and Markdown contain the remarks.
    if (options.format == ComparisonFormat::kCsv)
      for (const std::string& remark : comparison_remarks(run))
        say(MessageLevel::kError, run.name + ": " + remark);
  }
  std::fputs(comparison_text(runs, options.format, options.per_frame).c_str(), stdout);
  if (!compared_any) return fail(kExitFailed, "no frame and scheme in common");
  return options.threshold_percent ? report_checks(runs, found, options) : kExitDone;
}

}  // namespace tilepress
