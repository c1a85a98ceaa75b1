// Frame batch: ranges of frames on threads, results in order.
#include "frames/frame_batch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "frames/frame_notes.h"
#include "frames/stop_watch.h"
#include "tilepress/plugin_scheme.h"

namespace tilepress {
namespace {

/// Long ranges compute few frames twice; short ranges deliver rows sooner.
constexpr size_t kLongestRange = 64;
/// How often a waiting thread checks whether to stop.
constexpr std::chrono::milliseconds kStopPeriod{20};

class FrameBatch {
 public:
  FrameBatch(const ImageFrames& images, const std::vector<uint64_t>& numbers, const RunOptions& options,
             const std::string& pictures_path, const BlockLog& block_log, uint32_t jobs, const std::atomic<int>& stop)
      : stop_(stop),
        images_(images),
        numbers_(numbers),
        options_(options),
        pictures_path_(pictures_path),
        block_log_(block_log),
        range_(std::clamp<size_t>((numbers.size() + jobs - 1) / jobs, 1, kLongestRange)),
        ranges_((numbers.size() + range_ - 1) / range_) {}

  Result<bool> run(uint32_t jobs, const DeliverFrame& deliver) {
    std::vector<std::jthread> threads;
    for (uint32_t i = 0; i < std::min<size_t>(jobs, ranges_.size()); ++i)
      threads.emplace_back([this] { work(); });
    Result<bool> done = true;
    for (size_t i = 0; i < ranges_.size() && done && *done; ++i) done = deliver_range(ranges_[i], deliver);
    stopping_ = true;
    return done;
  }

 private:
  struct Range {
    struct Frame {
      FrameStatistics statistics;
      std::string log_record;
    };
    std::deque<Frame> ready;
    std::optional<Result<void>> end;  ///< set once no frame follows
  };

  Result<bool> deliver_range(Range& range, const DeliverFrame& deliver) {
    for (;;) {
      std::unique_lock lock(mutex_);
      const auto goes_on = [&] { return range.end || !range.ready.empty(); };
      while (!changed_.wait_for(lock, kStopPeriod, goes_on))
        if (stop_ != 0) return false;
      if (range.ready.empty() && !*range.end) return range.end->error();
      if (range.ready.empty()) return true;
      const Range::Frame frame = std::move(range.ready.front());
      range.ready.pop_front();
      lock.unlock();
      const auto delivered = deliver(frame.statistics, frame.log_record);
      if (!delivered || !*delivered) return delivered;
    }
  }

  void work() {
    Worker worker{images_.another(), {}, {}, FrameNotes(options_, pictures_path_, block_log_)};
    for (size_t r; !stopping_ && (r = next_range_++) < ranges_.size();) {
      const auto end = catch_plugin_fault([&] { return run_range(worker, r); });
      const std::lock_guard lock(mutex_);
      ranges_[r].end = end;
      changed_.notify_all();
    }
  }

  /// What each thread has of its own.
  struct Worker {
    ImageFrames images;
    ImageFrame frame;
    FrameStatistics statistics;
    FrameNotes notes;
  };

  Result<void> run_range(Worker& worker, size_t r) {
    SurfaceEngine engine(options_.schemes, options_.model);
    const size_t begin = r * range_, end = std::min(begin + range_, numbers_.size());
    for (uint64_t ordinal : engine.history(begin, worker.images.format())) {
      if (stopping_) return {};
      if (const auto done = run_frame(worker, engine, ordinal, false); !done) return done.error();
    }
    for (size_t ordinal = begin; ordinal < end && !stopping_; ++ordinal) {
      auto record = run_frame(worker, engine, ordinal, true);
      if (!record) return record.error();
      const std::lock_guard lock(mutex_);
      ranges_[r].ready.push_back({worker.statistics, std::move(*record)});
      changed_.notify_all();
    }
    return {};
  }

  /// Returns the record for the block log. `wanted`: false for a frame that only brings the engine up to date.
  Result<std::string> run_frame(Worker& worker, SurfaceEngine& engine, uint64_t ordinal, bool wanted) {
    FrameStatistics& statistics = worker.statistics;
    const uint64_t number = numbers_[ordinal];
    statistics.time_ns = clock_.nanoseconds();
    const auto read = worker.images.read(number, worker.frame);
    if (!read) return read.error();
    if (!*read)
      return Error{ErrorKind::kFile, "frame " + std::to_string(number) + ": is not there any more"};
    const SurfaceView view = worker.images.view(worker.frame);
    statistics.frame = number;
    statistics.readback_ns = worker.frame.decode_ns;
    engine.seek(ordinal);
    if (wanted) return worker.notes.process(engine, view, statistics);
    engine.note_block_bits(nullptr);
    engine.process(view, statistics);
    return std::string();
  }

  const std::atomic<int>& stop_;
  const ImageFrames& images_;
  const std::vector<uint64_t>& numbers_;
  const RunOptions& options_;
  const std::string& pictures_path_;
  const BlockLog& block_log_;
  const size_t range_;
  const StopWatch clock_;
  std::atomic<size_t> next_range_ = 0;
  std::atomic<bool> stopping_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Range> ranges_;
};

}  // namespace

Result<bool> run_frame_batch(const ImageFrames& images, const std::vector<uint64_t>& numbers,
                             const RunOptions& options, const std::string& pictures_path,
                             const BlockLog& block_log, uint32_t jobs, const std::atomic<int>& stop,
                             const DeliverFrame& deliver) {
  jobs = std::max(1u, jobs);
  return FrameBatch(images, numbers, options, pictures_path, block_log, jobs, stop).run(jobs, deliver);
}

}  // namespace tilepress
