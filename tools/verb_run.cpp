// tilepress run: a program under the shim, its own input, output and exit status passed through.
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "child_process.h"
#include "command_line.h"
#include "common_options.h"
#include "dumped_frames.h"
#include "program_kind.h"
#include "session_folder.h"
#include "shim_path.h"
#include "summary_table.h"
#include "tilepress/run_reader.h"
#include "tilepress/shim_environment.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kShimName = "libtilepress-preload.so";

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress run -o out -- glmark2-es2 -b desktop:duration=5\n"
    "  tilepress run -s vdcp -s vdcp:fvc=128,policy=2lfc -- glxgears\n"
    "  tilepress run --frames 100-199 --verify -- ./game --level 3\n"
    "  xvfb-run -a tilepress run -q -- glmark2\n"
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
  std::vector<std::string> program;
};

std::optional<int> parse_options(int argc, char** argv, LaunchOptions& options) {
  CLI::App app("Runs PROGRAM and captures every frame it presents through EGL or GLX.");
  app.get_formatter()->label("OPTIONS", "OPTIONS] -- PROGRAM [ARGS...");  // CLI11 puts it in brackets
  app.footer(kExamples);
  app.prefix_command();
  add_run_options(app, options.run);
  add_on_full_option(app, options.run);
  app.add_option("--via", options.via, "How the shim gets into the program (default: auto)")
      ->type_name("auto|preload|glvnd")
      ->check([](const std::string& road) {
        return parse_shim_road(road) ? std::string() : "not auto, preload or glvnd: " + road;
      });
  app.add_flag("-q,--quiet", options.quiet, "No summary");

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

/// Makes the output folder; false and one line in `error` if nothing can be written there. `made` = it was
/// not there before.
bool prepare_output(std::string& folder, bool& made, std::string& error) {
  namespace fs = std::filesystem;
  std::error_code code;
  folder = fs::absolute(folder, code).lexically_normal().string();
  made = fs::create_directories(folder, code);
  if (!code && !fs::is_directory(folder, code)) code = std::make_error_code(std::errc::not_a_directory);
  if (!code && access(folder.c_str(), W_OK | X_OK) != 0)
    code = std::error_code(errno, std::generic_category());
  if (code) error = folder + ": " + code.message();
  return !code;
}

std::optional<std::map<std::string, std::string>> child_environment(const LaunchOptions& options,
                                                                    const SessionFolder& session,
                                                                    const std::string& shim,
                                                                    std::string& error) {
  auto environment = to_environment(options.run);
  environment["TILEPRESS_SESSION"] = session.path();
  if (!add_shim_environment(environment, *parse_shim_road(options.via), session.preloadable(shim), error))
    return std::nullopt;
  return environment;
}

/// How the run of process `pid` is to be closed, as far as the launcher knows.
RunEnd end_of(pid_t pid, const ChildEnd& child) {
  RunEnd end;
  if (pid == child.pid && child.signal) {
    end.state = "killed by signal " + std::to_string(*child.signal);
    end.signal = child.signal;
  } else if (pid == child.pid) {
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
    RunRecord record;
    std::string error;
    const bool running = process.pid != child.pid && kill(process.pid, 0) == 0;
    const bool good = running ? read_run(process.run_path, record, error)
                              : close_run(process.run_path, end_of(process.pid, child), record, error);
    if (!good) {
      out.failures.push_back(error);
      continue;
    }
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
  const std::vector<std::string> seen = session.seen();
  for (const std::string& entry : seen) std::fprintf(stderr, "  seen: %s\n", entry.c_str());
  if (seen.empty()) std::fputs("  seen: no process asked for any of them\n", stderr);
  if (const std::string why = preload_obstacle(program_path); !why.empty())
    std::fprintf(stderr, "  %s: %s\n", program_path.c_str(), why.c_str());
  return kExitNothingCaptured;
}

}  // namespace

int verb_run(int argc, char** argv) {
  LaunchOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;

  StartFailure failure{};
  const auto program = find_program(options.program.front(), failure);
  if (!program) return fail(failure.status, failure.reason);
  std::string looked, error;
  const auto shim = find_shim(kShimName, looked);
  if (!shim)
    return fail(kExitLauncherFailed, std::string(kShimName) + ": not found (looked at " + looked + ")");
  bool made = false;
  if (!prepare_output(options.run.output, made, error)) return fail(kExitLauncherFailed, error);
  SessionFolder session;
  if (!session.create(error)) return fail(kExitLauncherFailed, error);
  options.run.log_file = session.log_path();

  const auto environment = child_environment(options, session, *shim, error);
  if (!environment) return fail(kExitLauncherFailed, error);
  const auto child = run_child(options.program, *environment, failure);
  if (!child) return fail(failure.status, failure.reason);

  for (const std::string& line : session.log_lines()) std::fprintf(stderr, "%s\n", line.c_str());
  const Harvest found = harvest(session, *child, options.quiet);
  for (const std::string& line : found.failures) fail(kExitLauncherFailed, line);
  if (made && found.captured == 0) {
    std::error_code code;
    std::filesystem::remove(options.run.output, code);  // only if it is empty
  }
  if (child->status() != 0) return child->status();
  if (!found.failures.empty()) return kExitLauncherFailed;
  if (found.captured == 0) return report_nothing(options, session, found, *program);
  if (found.mismatched_blocks > 0)
    return fail(kExitFailed,
                "--verify: " + std::to_string(found.mismatched_blocks) + " blocks differ after decoding");
  return kExitDone;
}

}  // namespace tilepress
