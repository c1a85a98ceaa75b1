// Trace rendering: one thread replays, this one packs.
#include "study/cache/trace_rendering.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <thread>

#include "study/cache/frame_cache.h"
#include "study/cache/frame_packer.h"
#include "temporary_folder.h"
#include "tilepress/utc_time.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLookPeriod{20};
constexpr const char* kRunName = "run";
/// Every run models some scheme. This one costs least.
constexpr const char* kCheapScheme = "red";

ReplayOptions replay_options(const RenderOptions& options, const std::string& output) {
  ReplayOptions replay;
  replay.run.output = output;
  replay.run.schemes = {*parse_scheme(kCheapScheme)};
  replay.run.dump_frames_every = 1;
  replay.retracer = options.retracer;
  replay.display = options.display;
  replay.timeout = options.timeout;
  replay.shim = options.shim;
  return replay;
}

/// The run that the replay writes now; empty if there is none. A replay without frames is tried on another
/// road.
std::string running_run(const std::string& output) {
  std::string found;
  std::error_code code;
  for (const auto& attempt : fs::directory_iterator(output + "/" + kRunName + ".partial", code))
    for (const auto& run : fs::directory_iterator(attempt.path() / "runs", code))
      if (fs::exists(run.path() / "frames.csv", code)) found = std::max(found, run.path().string());
  return found;
}

CacheOrigin origin_of(const ReplayInput& input, const CacheKey& key, const ReplayResult& result) {
  const RunInfo& info = result.run.info;
  CacheOrigin origin;
  origin.key = key.key;
  origin.input = fs::absolute(input.path).lexically_normal().string();
  origin.input_sha256 = key.input_sha256;
  origin.gl_vendor = info.gl_vendor;
  origin.gl_renderer = info.gl_renderer;
  origin.gl_version = info.gl_version;
  for (const auto& [name, value] : info.further)
    if (name == "retracer") origin.retracer = value;
  origin.pixel_options = key.pixel_options;
  origin.frame_set = key.frame_set;
  origin.version = TILEPRESS_VERSION;
  origin.rendered = utc_now();
  origin.reason = result.reason;
  origin.expected_frames = result.frames_wanted;
  origin.unsupported_frames = result.frames_unsupported;
  return origin;
}

/// Nothing is worth keeping: the next call tries again.
bool is_passing(const ReplayResult& result) {
  return result.status == ReplayStatus::kInterrupted || result.status == ReplayStatus::kNothingCaptured ||
         result.run.frames.empty();
}

class Rendering {
 public:
  Rendering(const ReplayInput& input, const RenderOptions& options, const std::string& output,
            FrameCacheWriter& writer)
      : options_(options),
        output_(output),
        replay_options_(replay_options(options, output)),
        replay_(named(input), replay_options_),
        packer_(writer) {}

  /// Replays and packs. Error: a file, not the replay.
  Result<void> run(const std::atomic<int>& stop) {
    if (!replay_.prepare(TraceReading::kMeanwhile)) return {};
    std::atomic<int> ending{0};
    std::atomic<bool> over{false};
    std::thread thread([&] {
      replay_.run(ending);
      over = true;
    });
    Result<void> packed;
    while (!over) {
      if (stop != 0) ending = stop.load();
      std::this_thread::sleep_for(kLookPeriod);
      const std::string run_path = running_run(output_);
      if (packed && !run_path.empty()) packed = packer_.pack(run_path, false);
      if (!packed) ending = SIGTERM;
      if (options_.progress) options_.progress(replay_.frames_done(), replay_.frames_wanted());
    }
    thread.join();
    if (packed && !replay_.result().run.path.empty()) packed = packer_.pack(replay_.result().run.path, true);
    return packed;
  }

  const ReplayResult& result() const { return replay_.result(); }

 private:
  static ReplayInput named(ReplayInput input) {
    input.name = kRunName;
    input.sha256.clear();  // the key has checked it
    return input;
  }

  const RenderOptions& options_;
  const std::string output_;
  const ReplayOptions replay_options_;
  TraceReplay replay_;
  FramePacker packer_;
};

}  // namespace

Result<CachedRendering> render_trace(const ReplayInput& input, const RenderOptions& options,
                                     const CacheKey& key, const std::string& path,
                                     const std::atomic<int>& stop) {
  TemporaryFolder folder;
  if (const auto created = folder.create(); !created) return about(input.path, created.error());
  FrameCacheWriter writer;
  if (const auto created = writer.create(path); !created) return about(input.path, created.error());
  spdlog::info("{}: rendered into {}", input.path, path);
  Rendering rendering(input, options, folder.path(), writer);
  const auto packed = rendering.run(stop);
  if (!packed) return about(input.path, packed.error());
  const ReplayResult& result = rendering.result();
  if (stop != 0) return Error{ErrorKind::kSystem, input.path + ": interrupted"};
  if (is_passing(result))
    return Error{result.frames_unsupported > 0 ? ErrorKind::kUnsupported : ErrorKind::kFile,
                 input.path + ": " + result.reason};
  if (const auto finished = writer.finish(origin_of(input, key, result)); !finished)
    return about(input.path, finished.error());
  return CachedRendering{.path = path, .rendered = true, .seconds = result.seconds, .reason = result.reason};
}

}  // namespace tilepress
