// Overhead rounds: the order changes from round to round, so that neither side profits from running later.
#include "capture/overhead_rounds.h"

#include <fmt/format.h>

#include <filesystem>

#include "capture/nothing_captured.h"
#include "capture/overhead_report.h"
#include "exit_status.h"
#include "streams/messages.h"
#include "streams/output_file.h"

namespace tilepress {
namespace {

std::string free_overhead_file(const std::string& folder) {
  std::string path = folder + "/overhead.csv";
  for (int suffix = 2; std::filesystem::exists(path); ++suffix)
    path = fmt::format("{}/overhead-{}.csv", folder, suffix);
  return path;
}

bool write_overhead(const std::string& folder, bool quiet, const std::vector<OverheadRun>& runs) {
  const std::string path = free_overhead_file(folder);
  if (const auto written = write_whole_file(path, overhead_csv(runs), false); !written) {
    fail(kExitLauncherFailed, written.error());
    return false;
  }
  if (!quiet) show(overhead_text(runs) + "  rows: " + path + "\n");
  return true;
}

}  // namespace

int measure_overhead(LaunchOptions options, unsigned rounds, const std::string& program_path) {
  const bool quiet = options.quiet;
  options.present_times = true;
  std::vector<OverheadRun> runs;
  int status = kExitDone;
  uint64_t captured = 0, seen = 0;
  for (unsigned turn = 0; turn < 2 * rounds; ++turn) {
    const unsigned round = turn / 2;
    options.capture = (turn + round) % 2 != 0;
    const bool last_with_rows = turn + 2 >= 2 * rounds && options.capture;
    options.quiet = quiet || !last_with_rows;
    SessionFolder session;
    const auto done = launch_program(options, session);
    if (!done) return fail(start_status(done.error()), done.error());
    const int ended_with = done->child.own_status();
    runs.push_back({round, options.capture, ended_with, busiest_series(session.path())});
    if (done->child.told_to_end) return ended_with;
    if (status == kExitDone) status = ended_with;
    if (ended_with != runs.front().exit_status)
      fail(kExitFailed, fmt::format("exit status {} in run {}, {} in the first", ended_with, turn + 1,
                                    runs.front().exit_status));
    captured += done->found.captured;
    seen += done->found.seen;
    if (done->found.failed && status == kExitDone) status = kExitLauncherFailed;
    if (turn + 1 == 2 * rounds && captured == 0 && status == kExitDone)
      status = report_nothing_captured(options, session, seen, program_path);
  }
  if (captured > 0 && !write_overhead(options.run.output, quiet, runs) && status == kExitDone)
    status = kExitLauncherFailed;
  return status;
}

}  // namespace tilepress
