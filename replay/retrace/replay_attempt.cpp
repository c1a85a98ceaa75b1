// Replay attempt: builds the retracer's environment, starts it and watches its rows.
#include "replay_attempt.h"

#include <spdlog/spdlog.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "frame_rows.h"
#include "private_xvfb.h"
#include "tilepress/program_search.h"
#include "tilepress/shim_environment.h"
#include "watched_process.h"

namespace tilepress {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookPeriod{50};
constexpr const char* kShimPrefix =
    "tilepress: ";  ///< of each line in the shim's log; the logger adds its own

std::map<std::string, std::string> environment_of(const ReplayRoad& road, const AttemptOrder& order,
                                                  const ReplayOptions& options, RunOptions run) {
  run.output = order.folder + "/runs";
  run.log_file = order.folder + "/session/log";
  std::map<std::string, std::string> environment = to_environment(run);
  environment["TILEPRESS_SESSION"] = order.folder + "/session";
  (void)add_shim_environment(environment, ShimRoad::kPreload, options.shim);
  environment["WAFFLE_PLATFORM"] = road.waffle_platform;
  // A replay must not see the window system of the desktop session.
  environment["EGL_PLATFORM"] = "";
  environment["WAYLAND_DISPLAY"] = "";
  if (road.display != ReplayDisplay::kX11) environment["DISPLAY"] = environment["XAUTHORITY"] = "";
  return environment;
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> seen_in(const std::string& folder) {
  std::vector<std::string> lines;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code))
    if (entry.path().extension() == ".seen")
      for (std::string& line : lines_of(entry.path())) lines.push_back(std::move(line));
  return lines;
}

/// Waits until the retracer ends, or ends it.
void watch(WatchedProcess& retracer, const AttemptOrder& order, const ReplayOptions& options,
           const std::function<bool()>& stop, std::atomic<uint64_t>& rows, AttemptOutcome& outcome) {
  FrameRows frames(order.folder + "/runs");
  auto moved = Clock::now();
  while (!retracer.wait(kLookPeriod)) {
    if (frames.look()) moved = Clock::now();
    rows.store(frames.count(), std::memory_order_relaxed);
    outcome.interrupted = stop();
    outcome.stopped_early = order.may_stop_early && frames.count() >= order.frames_wanted;
    outcome.hung = options.timeout.count() > 0 && Clock::now() - moved > options.timeout;
    if (!outcome.interrupted && !outcome.stopped_early && !outcome.hung) continue;
    retracer.end();
    return;
  }
  frames.look();
  rows.store(frames.count(), std::memory_order_relaxed);
}

}  // namespace

Result<AttemptOutcome> run_attempt(const ReplayRoad& road, const AttemptOrder& order,
                                   const ReplayOptions& options, const RunOptions& run,
                                   const std::function<bool()>& stop, std::atomic<uint64_t>& rows) {
  const Result<std::string> program = find_program(road.retracer);
  if (!program) return Error{program.error().kind, program.error().text + " (Debian package apitrace)"};
  std::error_code code;
  for (const char* part : {"/runs", "/session"})
    std::filesystem::create_directories(order.folder + part, code);
  if (code) return Error{ErrorKind::kFile, order.folder + ": " + code.message()};
  std::map<std::string, std::string> environment = environment_of(road, order, options, run);
  AttemptOutcome outcome;
  PrivateXvfb xvfb;
  if (road.display == ReplayDisplay::kXvfb) {
    const Result<void> up = xvfb.start(order.folder + "/session", order.width, order.height, stop);
    outcome.interrupted = !up && stop();
    if (outcome.interrupted) return outcome;
    if (!up) return up.error();
    environment["DISPLAY"] = xvfb.display();
    environment["XAUTHORITY"] = xvfb.authority();
  }
  WatchedProcess retracer;
  const auto begin = Clock::now();
  if (const auto started = retracer.start({*program, "-b", order.trace_path}, environment); !started)
    return started.error();
  watch(retracer, order, options, stop, rows, outcome);
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  outcome.exit_status = retracer.exit_status();
  outcome.signal = retracer.signal();
  outcome.last_lines.assign(retracer.errors().lines().begin(), retracer.errors().lines().end());
  outcome.seen = seen_in(order.folder + "/session");
  for (const std::string& line : lines_of(order.folder + "/session/log"))
    spdlog::info("{}", line.substr(line.starts_with(kShimPrefix) ? std::strlen(kShimPrefix) : 0));
  return outcome;
}

}  // namespace tilepress
