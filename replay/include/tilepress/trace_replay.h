// Trace replay: one recorded trace through a retracer under the shim, into a run directory.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/run_options.h"
#include "tilepress/run_reader.h"
#include "tilepress/trace_summary.h"

namespace tilepress {

/// Which of apitrace's retracers: eglretrace replays EGL and GLX calls, glretrace needs X.
enum class RetracerChoice : uint8_t { kAuto, kEgl, kGlx };
/// Where it draws: nowhere, on a private Xvfb, or on the X server of DISPLAY.
enum class ReplayDisplay : uint8_t { kAuto, kSurfaceless, kXvfb, kX11 };

struct ReplayOptions {
  RunOptions run;  ///< output: the folder of all replays, absolute
  RetracerChoice retracer = RetracerChoice::kAuto;
  ReplayDisplay display = ReplayDisplay::kAuto;
  std::chrono::seconds timeout{300};  ///< without any frame, until the retracer is taken for hung; 0 = never
  bool resume = false;                ///< keep finished replays of the same trace with the same options
  std::string shim;                   ///< libtilepress-preload.so, absolute, without spaces and colons
  /// Called with one line about what is done and why; from any thread.
  std::function<void(const std::string&)> explain = [](const std::string&) {};
};

/// A trace to replay and what is known of it.
struct ReplayInput {
  std::string path;
  std::string name;                ///< of the folder below the output folder
  std::string category;            ///< "UI", "2D", "3D" or empty
  std::string sha256;              ///< checked if not empty
  std::optional<FrameSet> frames;  ///< in place of the options' frames
};

enum class ReplayStatus : uint8_t {
  kWaiting,
  kDone,             ///< every frame asked for was captured
  kKept,             ///< --resume: it had been done before
  kFailed,           ///< not replayed, or not all frames were captured
  kInterrupted,      ///< a signal ended it before all frames were captured
  kNothingCaptured,  ///< a readable trace of which not one frame was captured
};

struct ReplayResult {
  ReplayStatus status = ReplayStatus::kWaiting;
  std::string reason;                       ///< one line without the path, unless done
  std::vector<std::string> retracer_lines;  ///< what the retracer said last, if it failed
  uint64_t frames_in_trace = 0;
  uint64_t frames_wanted = 0;  ///< of those, asked for
  uint64_t frames_captured = 0;
  double seconds = 0;  ///< start of the retracer to its end
  RunRecord run;       ///< as written; empty if nothing was captured
};

struct AttemptOutcome;
struct ReplayRoad;

/// When the whole trace is read, which is as long as its retracer takes to start, or longer.
enum class TraceReading : uint8_t {
  kBefore,     ///< the replay
  kMeanwhile,  ///< if nothing but the count of frames depends on it: no checksum, finished run or frame range
};

/// Usage: prepare(), then, if it returns true, run().
class TraceReplay {
 public:
  TraceReplay(ReplayInput input, const ReplayOptions& options);

  /// Finds what can be found before. False if there is nothing to run; result() then says why.
  bool prepare(TraceReading reading);
  /// Replays. Ends early, as interrupted, once `stop` is not 0, the number of the signal that ends us. Ends
  /// early, as failed, once the trace turns out not to be replayable.
  void run(const std::atomic<int>& stop);

  const ReplayInput& input() const { return input_; }
  /// After prepare() returned false, or after run().
  const ReplayResult& result() const { return result_; }
  /// Frames asked for, none until the trace is read; and those finished so far. From any thread.
  std::optional<uint64_t> frames_wanted() const;
  uint64_t frames_done() const { return frames_done_.load(std::memory_order_relaxed); }

 private:
  struct Attempt;
  bool can_be_read_meanwhile() const;
  bool read_trace();
  bool make_folder();
  void remove_folder();
  bool check_folder();
  bool keep_finished_run();
  void fail(std::string reason, ReplayStatus status = ReplayStatus::kFailed);
  std::string fingerprint() const;
  /// Reads the trace meanwhile, unless it is read.
  AttemptOutcome attempt_road(const ReplayRoad& road, const std::string& folder,
                              const std::atomic<int>& stop);
  void find_run(Attempt& attempt);
  void judge(const Attempt& attempt);
  void settle(Attempt& attempt);
  std::string end_text(const Attempt& attempt) const;
  std::string missing_text(const Attempt& attempt) const;

  ReplayInput input_;
  const ReplayOptions& options_;
  RunOptions run_options_;  ///< with the input's own frames
  TraceSummary trace_;
  std::string sha256_, run_path_, partial_path_;
  ReplayResult result_;
  bool read_ = false;
  std::vector<std::string> made_folders_;  ///< innermost first
  static constexpr uint64_t kUnknown = UINT64_MAX;
  std::atomic<uint64_t> frames_wanted_{kUnknown}, frames_done_{0};
};

}  // namespace tilepress
