// tilepress report: one page about one run or many.
#include <fnmatch.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "command_line.h"
#include "report/report_page.h"
#include "report/run_batch.h"
#include "streams/output_file.h"
#include "verb.h"

namespace tilepress {
namespace {

/// Values in all line charts of a page together; keeps a page of any batch below 10 MB.
constexpr size_t kPointBudget = 600000;
/// Frames with pictures on a page together, and of one run.
constexpr size_t kPictureBudget = 32, kPicturesPerRun = 8;

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output = "report.html";
  std::string title;
  std::vector<std::string> categories;  ///< PATTERN=CATEGORY
  EnergyModel energy;
};

/// The category of the first rule whose pattern matches the workload's name.
void apply_categories(const std::vector<std::string>& rules, RunSummary& run) {
  for (const std::string& rule : rules) {
    const size_t equals = rule.rfind('=');
    if (fnmatch(rule.substr(0, equals).c_str(), run.name.c_str(), 0) == 0) {
      run.category = rule.substr(equals + 1);
      return;
    }
  }
}

/// Loads and adds up every run, on all processors. Nothing is kept of a run but its summary.
bool summarise_all(const std::vector<BatchEntry>& entries, std::vector<RunSummary>& out, std::string& error) {
  out.resize(entries.size());
  std::vector<std::string> errors(entries.size());
  std::atomic<size_t> next{0};
  const size_t pictures_per_run = std::clamp<size_t>(kPictureBudget / entries.size(), 1, kPicturesPerRun);
  const auto work = [&] {
    for (size_t i = next++; i < entries.size(); i = next++) {
      const auto run = read_run(entries[i].path);
      if (!run) {
        errors[i] = run.error().text;
        continue;
      }
      out[i] = summarise_run(*run, entries[i].name, kPointBudget / entries.size());
      out[i].pictures = load_pictures(*run, pictures_per_run);
    }
  };
  std::vector<std::thread> threads(
      std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), entries.size()));
  for (std::thread& thread : threads) thread = std::thread(work);
  for (std::thread& thread : threads) thread.join();
  for (const std::string& one : errors) {
    if (one.empty()) continue;
    error = one;
    return false;
  }
  return true;
}

}  // namespace

int verb_report(int argc, char** argv) {
  ReportOptions options;
  CLI::App app{"Makes one HTML page about runs: rates, means, coverage, energy. It opens without a network."};
  app.add_option("RUN", options.runs, "Run directories, or folders that hold some")->required();
  app.add_option("-o,--output", options.output, "The page; - is standard output (default: report.html)")
      ->type_name("FILE");
  app.add_option("--title", options.title, "Heading of the page")->type_name("TEXT");
  app.add_option("--category", options.categories,
                 "Category of the workloads whose name matches, as 'glmark2*=3D'; repeatable")
      ->type_name("PATTERN=NAME")
      ->allow_extra_args(false)
      ->check([](const std::string& rule) {
        return rule.find('=') == std::string::npos ? "needs PATTERN=NAME, got '" + rule + "'" : "";
      });
  app.add_option("--dram-pj", options.energy.dram_pj_per_byte,
                 "Energy per byte moved in DRAM, pJ (default: 451.2)")
      ->type_name("PJ")
      ->check(CLI::PositiveNumber);
  app.add_option("--dcp-pj", options.energy.dcp_pj_per_byte,
                 "Energy of DCP's structures per raw byte, pJ (default: 4.83)")
      ->type_name("PJ")
      ->check(CLI::NonNegativeNumber);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  std::string error;
  const std::vector<BatchEntry> entries = find_runs(options.runs, error);
  if (entries.empty()) return fail(kExitFailed, error);
  Batch batch;
  batch.energy = options.energy;
  if (!summarise_all(entries, batch.runs, error)) return fail(kExitFailed, error);
  for (RunSummary& run : batch.runs) apply_categories(options.categories, run);
  arrange_batch(batch);
  std::string title = options.title;
  if (title.empty())
    title = entries.size() == 1 ? "Compression report: " + entries[0].name
                                : "Compression report: " + std::to_string(entries.size()) + " runs";
  if (!write_whole_file(options.output, report_page(batch, title), true, error))
    return fail(kExitFailed, error);
  return kExitDone;
}

}  // namespace tilepress
