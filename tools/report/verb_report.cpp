// tilepress report: one page about one run or many.
#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "command_line.h"
#include "counted.h"
#include "progress_line.h"
#include "report/category_rules.h"
#include "report/report_page.h"
#include "report/run_batch.h"
#include "streams/messages.h"
#include "streams/output_file.h"
#include "verb.h"

namespace tilepress {
namespace {

/// Values in all line charts of a page together. The budget keeps every page below 10 MB.
constexpr size_t kPointBudget = 600000;
/// Frames with pictures: on a page, and per run.
constexpr size_t kPictureBudget = 32, kPicturesPerRun = 8;

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress report out -o report.html\n"
    "  tilepress report out --category 'glmark2*=3D' --title 'Desktop and games'\n"
    "  tilepress report monday tuesday -o both.html\n";

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output = "report.html";
  std::string title;
  RunCategories categories;
  CostConstants energy;
};

/// Loads and adds up every run, on all processors.
Result<std::vector<RunSummary>> summarise_all(const std::vector<BatchEntry>& entries) {
  std::vector<RunSummary> out(entries.size());
  std::vector<Result<void>> read(entries.size());
  std::atomic<size_t> next{0};
  std::mutex shown;
  uint64_t done = 0;
  ProgressLine progress(ProgressMode::kAuto, "report", "runs");
  const size_t pictures_per_run = std::clamp<size_t>(kPictureBudget / entries.size(), 1, kPicturesPerRun);
  const auto work = [&] {
    for (size_t i = next++; i < entries.size(); i = next++) {
      const auto run = read_run(entries[i].path);
      if (!run) {
        read[i] = run.error();
        continue;
      }
      out[i] = summarise_run(*run, entries[i].name, kPointBudget / entries.size());
      out[i].pictures = load_pictures(*run, pictures_per_run);
      const std::lock_guard lock(shown);
      progress.show(++done, entries.size());
    }
  };
  std::vector<std::thread> threads(
      std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), entries.size()));
  for (std::thread& thread : threads) thread = std::thread(work);
  for (std::thread& thread : threads) thread.join();
  for (const Result<void>& one : read)
    if (!one) return one.error();
  return out;
}

}  // namespace

int verb_report(int argc, char** argv) {
  ReportOptions options;
  CLI::App app{"Writes one HTML page about runs: rates, means, coverage, energy. The page needs no network."};
  app.footer(kExamples);
  app.add_option("RUN", options.runs, "Run directories, or folders of run directories")->required();
  app.add_option("-o,--output", options.output, "HTML file to write; - for standard output (default: report.html)")
      ->type_name("FILE");
  app.add_option("--title", options.title, "Heading of the page")->type_name("TEXT");
  add_run_category_options(app, options.categories);
  app.add_option("--dram-pj", options.energy.dram_pj_per_byte,
                 "Energy per byte moved in DRAM, pJ (default: 451.2)")
      ->type_name("PJ")
      ->check(CLI::PositiveNumber);
  app.add_option("--dcp-pj", options.energy.structures_pj_per_byte,
                 "Energy of DCP's structures per raw byte, pJ (default: 4.83)")
      ->type_name("PJ")
      ->check(CLI::NonNegativeNumber);
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  const auto entries = find_runs(options.runs);
  if (!entries) return fail(kExitFailed, entries.error());
  if (const auto checked = check_category_rules(options.categories.rules, names_of(*entries)); !checked)
    return fail(kExitUsage, checked.error());
  auto runs = summarise_all(*entries);
  if (!runs) return fail(kExitFailed, runs.error());
  Batch batch;
  batch.energy = options.energy;
  batch.runs = std::move(*runs);
  for (RunSummary& run : batch.runs) run.category = options.categories.of(run.name, run.category);
  arrange_batch(batch);
  std::string title = options.title;
  if (title.empty())
    title = "Compression report: " +
            (entries->size() == 1 ? entries->front().name : counted(entries->size(), "run"));
  const auto written = write_whole_file(options.output, report_page(batch, title), true);
  if (!written) return fail(kExitFailed, written.error());
  if (options.output != "-")
    show(options.output + ": a page about " + counted(entries->size(), "run") + "\n");
  return kExitDone;
}

}  // namespace tilepress
