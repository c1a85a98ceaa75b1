// tilepress run: a program under the shim, its own input, output and exit status passed through.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "capture/child_process.h"
#include "command_line.h"
#include "common_options.h"
#include "frames/dumped_frames.h"
#include "capture/overhead_report.h"
#include "capture/present_costs.h"
#include "capture/program_kind.h"
#include "capture/session_folder.h"
#include "capture/shim_path.h"
#include "streams/output_file.h"
#include "summary_table.h"
#include "temporary_folder.h"
#include "tilepress/run_lock.h"
#include "tilepress/run_reader.h"
#include "tilepress/session_mark.h"
#include "tilepress/shim_environment.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kShimName = "libtilepress-preload.so";
constexpr const char* kTargetShimName =
    "libtilepress-preload-gl.so";  // exports the names that --targets watches

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress run -o out -- glmark2-es2 -b desktop:duration=5\n"
    "  tilepress run -s vdcp -s vdcp:fvc=128,policy=2lfc -- glxgears\n"
    "  tilepress run --frames 100-199 --verify -- ./game --level 3\n"
    "  xvfb-run -a tilepress run -q -- glmark2\n"
    "  tilepress run --measure-overhead --seconds 10 -- glxgears\n"
    "\n"
    "Each process that presents frames leaves its rows in DIR/<program>-<pid>/. Exit status: the program's "
    "own; 128+n\n"
    "if signal n ended it; 125 tilepress failed, 126 not executable, 127 not found; 3 if the program ended "
    "well and no\n"
    "frame was captured; 1 if --verify found a difference.\n";

struct LaunchOptions {
  RunOptions run;
  std::string via = "auto";
  bool quiet = false;
  bool measure_overhead = false;
  unsigned rounds = 2;
  double seconds = 0;  ///< 0 = until the program ends
  std::vector<std::string> program;
};

std::optional<int> parse_options(int argc, char** argv, LaunchOptions& options) {
  CLI::App app("Runs PROGRAM and captures every frame it presents through EGL or GLX.");
  app.get_formatter()->label("OPTIONS", "OPTIONS] -- PROGRAM [ARGS...");  // CLI11 puts it in brackets
  app.footer(kExamples);
  app.prefix_command();
  add_run_options(app, options.run);
  add_capture_options(app, options.run);
  app.add_option("--via", options.via, "How the shim gets into the program (default: auto)")
      ->type_name("auto|preload|glvnd")
      ->check([](const std::string& road) {
        return parse_shim_road(road) ? std::string() : "not auto, preload or glvnd: " + road;
      });
  app.add_flag("-q,--quiet", options.quiet, "No summary");
  app.add_flag("--measure-overhead", options.measure_overhead,
               "Run the program with and without capture, compare frame times, write DIR/overhead.csv");
  app.add_option("--rounds", options.rounds, "With --measure-overhead: runs of each kind (default: 2)")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  app.add_option("--seconds", options.seconds,
                 "End the program by SIGTERM after S seconds (default: it ends by itself)")
      ->type_name("S")
      ->check(CLI::Range(0.1, 86400.0));

  // All behind the first "--" is the program's, whatever it looks like.
  int own = 1;
  while (own < argc && std::strcmp(argv[own], "--") != 0) ++own;
  if (auto status = parse_command_line(app, own, argv)) return status;
  options.program = app.remaining();
  for (int i = own + 1; i < argc; ++i) options.program.emplace_back(argv[i]);
  if (options.program.empty()) return fail(kExitUsage, "no program given (see tilepress run --help)");
  if (own == argc && options.program.front().starts_with("-"))
    return fail(kExitUsage, "unknown option '" + options.program.front() + "'");
  if (own < argc && !app.remaining().empty()) {
    const std::string word = app.remaining().front();
    return fail(kExitUsage,
                (word.starts_with("-") ? "unknown option '" : "unexpected argument '") + word + "'");
  }
  if (options.run.output == "-") return fail(kExitUsage, "--output -: standard output is the program's");
  return std::nullopt;
}

/// The output folder. If the launcher has made it, it goes again unless something is in it.
class OutputFolder {
 public:
  OutputFolder() = default;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder() {
    std::error_code code;
    if (made_) std::filesystem::remove(path_, code);
  }
  /// Makes `folder` absolute, and makes it. Returns false and one line in `error` if nothing can be written
  /// there.
  bool prepare(std::string& folder, std::string& error) {
    namespace fs = std::filesystem;
    std::error_code code;
    fs::path path = fs::absolute(folder, code).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    folder = path_ = path.string();
    made_ = fs::create_directories(path, code);
    if (!code && !fs::is_directory(path, code)) code = std::make_error_code(std::errc::not_a_directory);
    if (!code && access(path_.c_str(), W_OK | X_OK) != 0)
      code = std::error_code(errno, std::generic_category());
    if (code) error = path_ + ": " + code.message();
    return !code;
  }

 private:
  std::string path_;
  bool made_ = false;
};

std::optional<std::map<std::string, std::string>> child_environment(const LaunchOptions& options,
                                                                    const SessionFolder& session,
                                                                    const std::string& library, bool capture,
                                                                    std::string& error) {
  auto environment = to_environment(options.run);
  environment["TILEPRESS_SESSION"] = session.path();
  environment["TILEPRESS_CAPTURE"] = capture ? "" : "off";
  environment["TILEPRESS_PRESENT_TIMES"] = options.measure_overhead ? session.path() : "";
  if (const auto added = add_shim_environment(environment, *parse_shim_road(options.via), library); !added) {
    error = added.error().text;
    return std::nullopt;
  }
  return environment;
}

/// Whether `process` is the one that the launcher has started. In another PID namespace any process may have
/// its number. A process without /proc does not know its namespace.
bool is_child(const CapturedProcess& process, const ChildEnd& child) {
  return process.pid == child.pid &&
         (process.pid_namespace == 0 || process.pid_namespace == own_pid_namespace());
}

/// How a run is to be closed, as far as the launcher knows. A run that ended normally says so itself.
RunEnd end_of(const CapturedProcess& process, const ChildEnd& child) {
  RunEnd end;
  if (is_child(process, child) && child.signal) {
    end.state = "killed by signal " + std::to_string(*child.signal);
    end.signal = child.signal;
  } else if (is_child(process, child)) {
    end.exit_status = child.exit_status;
  } else {
    end.state = "ended";
    end.reason = "the process ended without telling: killed, or by _exit";
  }
  return end;
}

/// What came of the processes of a session.
struct Harvest {
  uint64_t captured = 0;
  uint64_t seen = 0;
  uint64_t mismatched_blocks = 0;
  std::vector<std::string> failures;
};

Harvest harvest(const SessionFolder& session, const ChildEnd& child, bool quiet) {
  Harvest out;
  for (const CapturedProcess& process : session.captured()) {
    const bool ended = is_child(process, child);
    const bool running = !wait_for_writer(process.run_path, ended) && !ended;
    Result<RunRecord> read = read_run(process.run_path);
    const Result<void> closed = !read     ? Result<void>(read.error())
                                : running ? Result<void>()
                                          : close_run(end_of(process, child), *read);
    if (!closed) {
      out.failures.push_back(closed.error().text);
      continue;
    }
    const RunRecord& record = *read;
    std::string error;
    if (!running && !convert_dumped_frames(process.run_path, error)) out.failures.push_back(error);
    out.captured += record.frames.size();
    out.seen += record.counts.seen;
    for (const FrameStatistics& frame : record.frames)
      for (const SchemeStatistics& scheme : frame.schemes) out.mismatched_blocks += scheme.mismatched_blocks;
    if (record.state == "failed") out.failures.push_back(process.run_path + ": " + record.reason);
    if (quiet) continue;
    const std::string title =
        record.info.program + " (" + std::to_string(process.pid) + (running ? ", still running)" : ")");
    std::fputs(summary_table(record, title).c_str(), stderr);
    std::fputs(present_costs_text(present_costs(record)).c_str(), stderr);
    std::fprintf(stderr, "  rows: %s/schemes.csv and frames.csv\n", process.run_path.c_str());
  }
  return out;
}

/// Tells what was looked for and what was seen.
int report_nothing(const LaunchOptions& options, const SessionFolder& session, const Harvest& found,
                   const std::string& program_path) {
  std::string line = options.program.front() + ": no frame captured";
  if (found.seen > 0)
    line += ": " + std::to_string(found.seen) +
            " presented, none of them asked for, readable and in a modelled format";
  fail(kExitNothingCaptured, line);
  std::fputs(
      "  looked for: eglSwapBuffers, eglSwapBuffersWithDamageKHR and EXT, glXSwapBuffers and their kin,\n"
      "  linked, by dlsym, or by eglGetProcAddress and glXGetProcAddress\n",
      stderr);
  if (options.run.triggers == 0)
    std::fputs("  a program that draws and presents nothing: --trigger finish,flush,readpixels\n", stderr);
  const std::vector<std::string> seen = session.seen();
  for (const std::string& entry : seen) std::fprintf(stderr, "  seen: %s\n", entry.c_str());
  const std::vector<std::string> unreached = session.seen_from_afar();
  for (const std::string& entry : unreached) std::fprintf(stderr, "  seen: %s\n", entry.c_str());
  const char* folder = options.run.output.c_str();
  if (!unreached.empty())
    std::fprintf(stderr,
                 "  these processes could not write to the session folder in %s: they have another root, /tmp "
                 "or user.\n  Use -o with a folder that they see under the same path and may write\n",
                 folder);
  else if (seen.empty())
    std::fprintf(stderr,
                 "  seen: nothing: no process that reaches the session folder in %s asked for any of them.\n"
                 "  A process in a container, or with another root, /tmp or user, may not reach it\n",
                 folder);
  if (const std::string why = preload_obstacle(program_path); !why.empty())
    std::fprintf(stderr, "  %s: %s\n", program_path.c_str(), why.c_str());
  return kExitNothingCaptured;
}

struct Launch {
  ChildEnd child;
  Harvest found;
};

/// Runs the program once; nothing, with the exit status in `status`, if it could not be started.
std::optional<Launch> launch(const LaunchOptions& options, const std::string& shim, bool capture, bool quiet,
                             SessionFolder& session, int& status) {
  std::string error;
  StartFailure failure{};
  const auto abandon = [&](int code, const std::string& line) {
    status = fail(code, line);
    return std::nullopt;
  };
  TemporaryFolder links;
  if (!session.create(options.run.output, error)) return abandon(kExitLauncherFailed, error);
  const std::string library = preloadable(shim, links, error);
  if (library.empty()) return abandon(kExitLauncherFailed, error);
  LaunchOptions own = options;
  own.run.log_file = session.log_path();
  const auto environment = child_environment(own, session, library, capture, error);
  if (!environment) return abandon(kExitLauncherFailed, error);
  const auto child = run_child(options.program, *environment, failure, options.seconds);
  if (!child) return abandon(failure.status, failure.reason);
  for (const std::string& line : session.log_lines()) std::fprintf(stderr, "%s\n", line.c_str());
  Launch out{*child, harvest(session, *child, quiet)};
  for (const std::string& line : out.found.failures) fail(kExitLauncherFailed, line);
  return out;
}

int own_status(const ChildEnd& child) {
  return child.ended_by_limit ? 0 : child.status();
}

/// The first name of overhead.csv, overhead-2.csv, … that is free.
std::string free_overhead_file(const std::string& folder) {
  std::string path = folder + "/overhead.csv";
  for (int suffix = 2; std::filesystem::exists(path); ++suffix)
    path = folder + "/overhead-" + std::to_string(suffix) + ".csv";
  return path;
}

bool write_overhead(const LaunchOptions& options, const std::vector<OverheadRun>& runs) {
  const std::string path = free_overhead_file(options.run.output);
  std::string error;
  const bool written = write_whole_file(path, overhead_csv(runs), false, error);
  if (!written) fail(kExitLauncherFailed, error);
  if (written && !options.quiet)
    std::fprintf(stderr, "%s  rows: %s\n", overhead_text(runs).c_str(), path.c_str());
  return written;
}

/// The program with and without capture, `rounds` times, the order changing from round to round.
int measure_overhead(const LaunchOptions& options, const std::string& shim, const std::string& program) {
  std::vector<OverheadRun> runs;
  int status = 0;
  Harvest sum;
  for (unsigned turn = 0; turn < 2 * options.rounds; ++turn) {
    const unsigned round = turn / 2;
    const bool capture = (turn + round) % 2 != 0;
    const bool last = turn + 2 >= 2 * options.rounds && capture;
    SessionFolder session;
    int failed = 0;
    const auto done = launch(options, shim, capture, options.quiet || !last, session, failed);
    if (!done) return failed;
    runs.push_back({round, capture, own_status(done->child), busiest_series(session.path())});
    if (done->child.told_to_end) return runs.back().exit_status;
    if (status == 0) status = runs.back().exit_status;
    if (runs.back().exit_status != runs.front().exit_status)
      fail(kExitFailed, "exit status " + std::to_string(runs.back().exit_status) + " in run " +
                            std::to_string(turn + 1) + ", " + std::to_string(runs.front().exit_status) +
                            " in the first");
    sum.captured += done->found.captured;
    sum.seen += done->found.seen;
    if (!done->found.failures.empty() && status == 0) status = kExitLauncherFailed;
    if (turn + 1 == 2 * options.rounds && sum.captured == 0 && status == 0)
      status = report_nothing(options, session, sum, program);
  }
  if (sum.captured > 0 && !write_overhead(options, runs) && status == 0) status = kExitLauncherFailed;
  return status;
}

}  // namespace

int verb_run(int argc, char** argv) {
  LaunchOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;

  StartFailure failure{};
  const auto program = find_program(options.program.front(), failure);
  if (!program) return fail(failure.status, failure.reason);
  std::string looked, error;
  const char* shim_name = options.run.all_targets ? kTargetShimName : kShimName;
  const auto shim = find_shim(shim_name, looked);
  if (!shim)
    return fail(kExitLauncherFailed, std::string(shim_name) + ": not found (looked at " + looked + ")");
  OutputFolder output;
  if (!output.prepare(options.run.output, error)) return fail(kExitLauncherFailed, error);
  if (options.measure_overhead) return measure_overhead(options, *shim, *program);

  SessionFolder session;
  int status = 0;
  const auto done = launch(options, *shim, true, options.quiet, session, status);
  if (!done) return status;
  const Harvest& found = done->found;
  if (own_status(done->child) != 0) return own_status(done->child);
  if (!found.failures.empty()) return kExitLauncherFailed;
  if (found.captured == 0) return report_nothing(options, session, found, *program);
  if (found.mismatched_blocks > 0)
    return fail(kExitFailed,
                "--verify: " + std::to_string(found.mismatched_blocks) + " blocks differ after decoding");
  return kExitDone;
}

}  // namespace tilepress
