// Program launch: environment, child, and a look at each run folder of the session.
#include "capture/program_launch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "capture/shim_launch.h"
#include "frames/dumped_frames.h"
#include "streams/messages.h"
#include "summary_table.h"
#include "tilepress/csv_rows.h"
#include "tilepress/present_rows.h"
#include "tilepress/run_folder.h"
#include "tilepress/run_lock.h"
#include "tilepress/run_reader.h"

namespace tilepress {
namespace {

/// Whether the launcher started `process` itself. Another PID namespace may use the child's number for
/// another process. A process without /proc does not know its namespace.
bool is_child(const CapturedProcess& process, const ChildEnd& child) {
  return process.pid == child.pid &&
         (process.pid_namespace == 0 || process.pid_namespace == own_pid_namespace());
}

/// How to close a run that has not closed itself.
RunEnd end_of(const CapturedProcess& process, const ChildEnd& child) {
  RunEnd end;
  if (!is_child(process, child)) {
    end.state = "ended";
    end.reason = "the process ended without telling: killed, or by _exit";
  } else if (child.signal) {
    end.state = "killed by signal " + std::to_string(*child.signal);
    end.signal = child.signal;
  } else {
    end.exit_status = child.exit_status;
  }
  return end;
}

/// Means over the captured frames that are not warmup.
struct PresentCosts {
  uint64_t frames = 0;  ///< 0 = the run has no presents.csv: it was not captured from a program
  double readback_ns = 0, read_ns = 0, bind_ns = 0, hand_off_ns = 0;  ///< on the program's thread
  double wait_ns = 0;    ///< on that thread, for room in the queue
  double encode_ns = 0;  ///< on the worker's thread
};

PresentCosts present_costs(const RunRecord& run) {
  PresentCosts costs;
  constexpr std::pair<uint64_t PresentRow::*, double PresentCosts::*> kSums[] = {
      {&PresentRow::readback_ns, &PresentCosts::readback_ns},
      {&PresentRow::read_ns, &PresentCosts::read_ns},
      {&PresentRow::bind_ns, &PresentCosts::bind_ns},
      {&PresentRow::hand_off_ns, &PresentCosts::hand_off_ns},
      {&PresentRow::wait_ns, &PresentCosts::wait_ns}};
  for_each_csv_row<PresentRow>(run.path + "/presents.csv", kPresentColumns, [&](const PresentRow& row) {
    if (row.frame == 0) return;  // frame 0 also pays for the start
    ++costs.frames;
    for (const auto& [part, sum] : kSums) costs.*sum += static_cast<double>(row.*part);
  });
  if (costs.frames == 0) return costs;
  for (const auto& [part, sum] : kSums) costs.*sum /= static_cast<double>(costs.frames);
  for (const FrameStatistics& frame : run.frames)
    if (!frame.warmup) costs.encode_ns += static_cast<double>(frame.encode_ns);
  costs.encode_ns /= static_cast<double>(std::max<uint64_t>(run.measured_frames, 1));
  return costs;
}

std::string present_costs_text(const PresentCosts& costs) {
  if (costs.frames == 0) return {};
  const auto ms = [](double ns) { return ns / 1e6; };
  return fmt::format(
      "  per frame: {:.2f} ms readback (read {:.2f}, making current {:.2f}), {:.3f} ms hand-off, {:.2f} ms "
      "waiting for the queue;\n             {:.2f} ms encoding on the worker's thread\n",
      ms(costs.readback_ns), ms(costs.read_ns), ms(costs.bind_ns), ms(costs.hand_off_ns), ms(costs.wait_ns),
      ms(costs.encode_ns));
}

void show_summary(const CapturedProcess& process, const RunRecord& run, bool running) {
  show(summary_table(
           run, fmt::format("{} ({}{})", run.info.program, process.pid, running ? ", still running" : "")) +
       present_costs_text(present_costs(run)) +
       fmt::format("  rows: {}/schemes.csv and frames.csv\n", process.run_path));
}

void close_and_add(const CapturedProcess& process, const ChildEnd& child, const LaunchOptions& options,
                   Harvest& sum) {
  const auto note = [&sum](const std::string& error) {
    say(MessageLevel::kError, error);
    sum.failed = true;
  };
  const bool ended = is_child(process, child);
  const bool running = !wait_for_writer(process.run_path, ended) && !ended;
  Result<RunRecord> read = read_run(process.run_path);
  if (!read) return note(read.error().text);
  RunRecord& run = *read;
  if (!running) {
    RunEnd end = end_of(process, child);
    end.further = options.labels;
    if (const auto closed = close_run(end, run); !closed) return note(closed.error().text);
    if (const auto converted = convert_dumped_frames(process.run_path); !converted)
      note(converted.error().text);
  }
  sum.captured += run.frames.size();
  sum.seen += run.counts.seen;
  for (const FrameStatistics& frame : run.frames)
    for (const SchemeStatistics& scheme : frame.schemes) sum.mismatched_blocks += scheme.mismatched_blocks;
  if (!options.quiet) show_summary(process, run, running);
  if (run.state == "failed") note(process.run_path + ": " + run.reason);
}

}  // namespace

Result<Launch> launch_program(const LaunchOptions& options, SessionFolder& session) {
  if (const auto made = session.create(options.run.output); !made)
    return Error{ErrorKind::kSystem, made.error().text};
  auto variables = shim_variables(options.run, session, options.via, options.shim);
  if (!variables) return Error{ErrorKind::kSystem, variables.error().text};
  (*variables)["TILEPRESS_CAPTURE"] = options.capture ? "" : "off";
  (*variables)["TILEPRESS_PRESENT_TIMES"] = options.present_times ? session.path() : "";
  const auto child = run_child(options.program, *variables, options.seconds);
  if (!child) return child.error();
  for (const std::string& line : session.log_lines()) show(line + "\n");
  Launch launch{*child, {}, session.captured()};
  for (const CapturedProcess& process : launch.processes)
    close_and_add(process, *child, options, launch.found);
  return launch;
}

}  // namespace tilepress
