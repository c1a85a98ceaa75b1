// Trace replay: replays one recorded trace through a retracer under the shim, into a run directory.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/run_options.h"
#include "tilepress/run_reader.h"
#include "tilepress/trace_summary.h"

namespace tilepress {

/// Which of apitrace's retracers: eglretrace replays EGL and GLX calls, glretrace needs an X server.
enum class RetracerChoice : uint8_t { kAuto, kEgl, kGlx };
/// Where the retracer draws: nowhere, on a private Xvfb, or on the X server of DISPLAY.
enum class ReplayDisplay : uint8_t { kAuto, kSurfaceless, kXvfb, kX11 };

struct ReplayOptions {
  RunOptions run;  ///< output: the folder of all replays, absolute
  RetracerChoice retracer = RetracerChoice::kAuto;
  ReplayDisplay display = ReplayDisplay::kAuto;
  std::chrono::seconds timeout{
      300};             ///< time without a frame after which a retracer counts as hung; 0 = never
  bool resume = false;  ///< keep finished replays of the same trace with the same options
  std::string shim;     ///< libtilepress-preload.so, absolute, without spaces and colons
};

/// A trace to replay and what the caller knows about it.
struct ReplayInput {
  std::string path;
  std::string name;                ///< of the folder below the output folder
  std::string category;            ///< "UI", "2D", "3D" or empty
  std::string sha256;              ///< checked unless empty
  std::optional<FrameSet> frames;  ///< in place of the options' frames
};

enum class ReplayStatus : uint8_t {
  kWaiting,
  kDone,             ///< every frame asked for was captured
  kKept,             ///< --resume: an earlier replay did it
  kFailed,           ///< not replayed, or not all frames were captured
  kInterrupted,      ///< a signal ended it before all frames were captured
  kNothingCaptured,  ///< the trace is readable, and no frame was captured
};

struct ReplayResult {
  ReplayStatus status = ReplayStatus::kWaiting;
  std::string reason;                       ///< one line without the path; empty if done
  std::vector<std::string> retracer_lines;  ///< the retracer's last lines, if it failed
  uint64_t frames_in_trace = 0;
  uint64_t frames_wanted = 0;  ///< frames of the trace that were asked for
  uint64_t frames_captured = 0;
  uint64_t frames_unsupported = 0;  ///< presented in a format that tilepress does not model
  double seconds = 0;  ///< from the start of the retracer to its end
  RunRecord run;       ///< as written; empty if nothing was captured
};

/// When the whole trace is read. Reading takes as long as its retracer takes to start, or longer.
enum class TraceReading : uint8_t {
  kBefore,     ///< before the replay
  kMeanwhile,  ///< during the replay, if only the count of frames depends on it: no checksum, no finished run
               ///< and no frame range
};

class ReplayFolder;
struct AttemptOutcome;
struct ReplayRoad;

/// One replay. Call prepare(), and run() if it returned true. Logs each step through spdlog's default logger
/// at level info.
class TraceReplay {
 public:
  TraceReplay(ReplayInput input, const ReplayOptions& options);  ///< `options` must outlive the replay
  ~TraceReplay();

  /// Checks the trace and the folders. Returns false if there is nothing to run; result() then says why.
  bool prepare(TraceReading reading);
  /// Replays. Ends early, as interrupted, once `stop` holds the number of a signal, or, as failed, once the
  /// trace proves to be damaged or empty.
  void run(const std::atomic<int>& stop);

  const ReplayInput& input() const { return input_; }
  /// Valid after prepare() returned false, or after run().
  const ReplayResult& result() const { return result_; }
  /// Frames asked for, none until the trace is read. From any thread.
  std::optional<uint64_t> frames_wanted() const;
  /// Frames finished so far. From any thread.
  uint64_t frames_done() const { return frames_done_.load(std::memory_order_relaxed); }

 private:
  bool fail(std::string reason, ReplayStatus status = ReplayStatus::kFailed);  ///< returns false
  bool can_be_read_meanwhile() const;
  bool read_trace();
  bool check_folder();
  bool keep_finished_run();
  std::string fingerprint() const;
  bool try_road(const ReplayRoad& road, const std::string& folder, const std::atomic<int>& stop);
  Result<AttemptOutcome> read_and_attempt(const ReplayRoad& road, const std::string& folder,
                                          const std::atomic<int>& stop);
  void settle(const ReplayRoad& road, const AttemptOutcome& outcome, RunRecord run, int stop_signal);

  ReplayInput input_;
  const ReplayOptions& options_;
  RunOptions run_options_;  ///< with the input's own frames
  std::unique_ptr<ReplayFolder> folder_;
  TraceSummary trace_;
  std::string sha256_;
  ReplayResult result_;
  bool read_ = false;
  static constexpr uint64_t kUnknown = UINT64_MAX;
  std::atomic<uint64_t> frames_wanted_{kUnknown}, frames_done_{0};
};

}  // namespace tilepress
