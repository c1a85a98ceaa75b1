// Program launch: environment, child, and a look at each run folder of the session.
#include "capture/program_launch.h"

#include <fmt/format.h>

#include "capture/present_costs.h"
#include "capture/shim_launch.h"
#include "frames/dumped_frames.h"
#include "streams/messages.h"
#include "summary_table.h"
#include "tilepress/run_lock.h"
#include "tilepress/run_reader.h"
#include "tilepress/run_folder.h"

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

void show_summary(const CapturedProcess& process, const RunRecord& run, bool running) {
  show(summary_table(
           run, fmt::format("{} ({}{})", run.info.program, process.pid, running ? ", still running" : "")) +
       present_costs_text(present_costs(run)) +
       fmt::format("  rows: {}/schemes.csv and frames.csv\n", process.run_path));
}

void close_and_add(const CapturedProcess& process, const ChildEnd& child, bool quiet, Harvest& sum) {
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
    if (const auto closed = close_run(end_of(process, child), run); !closed) return note(closed.error().text);
    if (const auto converted = convert_dumped_frames(process.run_path); !converted)
      note(converted.error().text);
  }
  sum.captured += run.frames.size();
  sum.seen += run.counts.seen;
  for (const FrameStatistics& frame : run.frames)
    for (const SchemeStatistics& scheme : frame.schemes) sum.mismatched_blocks += scheme.mismatched_blocks;
  if (!quiet) show_summary(process, run, running);
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
  Launch launch{*child, {}};
  for (const CapturedProcess& process : session.captured())
    close_and_add(process, *child, options.quiet, launch.found);
  return launch;
}

}  // namespace tilepress
