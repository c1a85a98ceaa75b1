// Traced frames: the two sources.
#include "memory_trace/traced_frames.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "frames/packed_reader.h"
#include "tilepress/block_log.h"
#include "tilepress/run_reader.h"

namespace tilepress {
namespace {

class LoggedFrames : public TracedFrames {
 public:
  Result<void> open(const std::string& path, bool has_times) {
    has_times_ = has_times;
    return log_.open(path);
  }
  const std::vector<LoggedFrame>& frames() const override { return log_.frames(); }
  const CompressedSurface& model() const override { return log_.model(); }
  bool has_data() const override { return log_.has_data(); }
  bool has_times() const override { return has_times_; }
  Result<void> read(size_t index, CompressedSurface& out) override { return log_.read(index, out); }

 private:
  BlockLogReader log_;
  bool has_times_ = false;
};

/// Surfaces of one size and format in a file are one surface of the trace.
class PackedFrames : public TracedFrames {
 public:
  Result<void> open(const std::string& path) {
    auto file = open_packed_file(path);
    if (!file) return file.error();
    file_ = std::move(*file);
    std::vector<std::tuple<uint32_t, uint32_t, PixelFormat>> shapes;
    CompressedSurface surface;
    for (uint32_t number = 0; number < file_->reader.count(); ++number) {
      if (const auto done = read(number, surface); !done) return done;
      if (number == 0) model_ = surface;
      if (surface.burst_bits != model_.burst_bits || surface.scheme.text != model_.scheme.text)
        return Error{ErrorKind::kUnsupported, path + ": surface " + std::to_string(number) +
                                                  " has another scheme or burst than the first; a trace has one"};
      const std::tuple shape(surface.width, surface.height, surface.format);
      auto known = std::ranges::find(shapes, shape);
      if (known == shapes.end()) known = shapes.insert(known, shape);
      frames_.push_back({number, static_cast<uint32_t>(known - shapes.begin()), 0, surface.table_bits, 0});
    }
    return {};
  }
  const std::vector<LoggedFrame>& frames() const override { return frames_; }
  const CompressedSurface& model() const override { return model_; }
  bool has_data() const override { return true; }
  bool has_times() const override { return false; }
  Result<void> read(size_t index, CompressedSurface& out) override {
    const auto done = file_->reader.read(static_cast<uint32_t>(index), out);
    return done ? done : about(file_->path, done.error());
  }

 private:
  std::unique_ptr<PackedFile> file_;
  CompressedSurface model_;
  std::vector<LoggedFrame> frames_;
};

/// Whether the presents of a run happened when a program wanted them.
Result<bool> has_program_times(const std::string& folder) {
  const auto run = read_run(folder);
  if (!run) return run.error();
  const bool replayed = std::ranges::any_of(run->info.further, [](const auto& member) { return member.first == "trace"; });
  return run->info.via != "frames" && !replayed;
}

}  // namespace

Result<std::unique_ptr<TracedFrames>> open_logged_frames(const std::string& path, bool has_times) {
  auto frames = std::make_unique<LoggedFrames>();
  if (const auto opened = frames->open(path, has_times); !opened) return opened.error();
  return std::unique_ptr<TracedFrames>(std::move(frames));
}

Result<std::unique_ptr<TracedFrames>> open_traced_frames(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_directory(path, code)) {
    auto frames = std::make_unique<PackedFrames>();
    if (const auto opened = frames->open(path); !opened) return opened.error();
    return std::unique_ptr<TracedFrames>(std::move(frames));
  }
  const std::string log = path + "/" + std::string(kBlockLogName);
  if (!std::filesystem::exists(log, code))
    return Error{ErrorKind::kFile, path + ": holds no " + std::string(kBlockLogName) +
                                       "; capture it with --memory-trace FILE"};
  const auto has_times = has_program_times(path);
  if (!has_times) return has_times.error();
  return open_logged_frames(log, *has_times);
}

}  // namespace tilepress
