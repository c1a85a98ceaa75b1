// Frame batch: ranges of frames on threads, results in order.
#include "frames/frame_batch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "tilepress/frame_pictures.h"

namespace tilepress {
namespace {

/// Long enough that the frames computed twice hardly count, short enough that rows keep coming.
constexpr size_t kLongestRange = 64;
/// How often a thread that waits for a frame looks whether it is to stop.
constexpr std::chrono::milliseconds kStopPeriod{20};

class FrameBatch {
 public:
  FrameBatch(const ImageFrames& images, const std::vector<uint64_t>& numbers, const RunOptions& options,
             const std::string& pictures_path, uint32_t jobs, const std::atomic<int>& stop)
      : stop_(stop),
        images_(images),
        numbers_(numbers),
        options_(options),
        pictures_path_(pictures_path),
        range_(std::clamp<size_t>((numbers.size() + jobs - 1) / jobs, 1, kLongestRange)),
        ranges_((numbers.size() + range_ - 1) / range_) {}

  bool run(uint32_t jobs, const std::function<bool(const FrameStatistics&)>& deliver, std::string& error) {
    std::vector<std::jthread> threads;
    for (uint32_t i = 0; i < std::min<size_t>(jobs, ranges_.size()); ++i)
      threads.emplace_back([this] { work(); });
    bool good = true;
    for (Range& range : ranges_)
      if (!(good = deliver_range(range, deliver, error))) break;
    stopping_ = true;
    return good;
  }

 private:
  struct Range {
    std::deque<FrameStatistics> ready;
    bool ended = false;
    std::string error;
  };

  bool deliver_range(Range& range, const std::function<bool(const FrameStatistics&)>& deliver,
                     std::string& error) {
    for (;;) {
      std::unique_lock lock(mutex_);
      const auto goes_on = [&] { return range.ended || !range.ready.empty(); };
      while (!changed_.wait_for(lock, kStopPeriod, goes_on))
        if (stop_ != 0) return false;
      if (range.ready.empty()) {
        error = range.error;
        return error.empty();
      }
      const FrameStatistics statistics = std::move(range.ready.front());
      range.ready.pop_front();
      lock.unlock();
      if (!deliver(statistics)) return false;
    }
  }

  void work() {
    Worker worker{images_.another(), {}, {}, {}};
    if (!pictures_path_.empty()) worker.pictures.open(pictures_path_, options_);
    for (size_t r; !stopping_ && (r = next_range_++) < ranges_.size();) {
      std::string error = run_range(worker, r);
      const std::lock_guard lock(mutex_);
      ranges_[r].error = std::move(error);
      ranges_[r].ended = true;
      changed_.notify_all();
    }
  }

  /// What a thread needs for itself.
  struct Worker {
    ImageFrames images;
    ImageFrame frame;
    FrameStatistics statistics;
    FramePictures pictures;
  };

  /// One line on failure, else empty.
  std::string run_range(Worker& worker, size_t r) {
    SurfaceEngine engine(options_.schemes, options_.model);
    const size_t begin = r * range_, end = std::min(begin + range_, numbers_.size());
    std::string error;
    for (uint64_t ordinal : engine.history(begin, worker.images.format()))
      if (stopping_ || !run_frame(worker, engine, ordinal, false, error)) return error;
    for (size_t ordinal = begin; ordinal < end && !stopping_; ++ordinal) {
      if (!run_frame(worker, engine, ordinal, true, error)) return error;
      const std::lock_guard lock(mutex_);
      ranges_[r].ready.push_back(worker.statistics);
      changed_.notify_all();
    }
    return {};
  }

  /// `wanted`: false for a frame that only brings the engine up to date.
  bool run_frame(Worker& worker, SurfaceEngine& engine, uint64_t ordinal, bool wanted, std::string& error) {
    ImageFrames& images = worker.images;
    ImageFrame& frame = worker.frame;
    FrameStatistics& statistics = worker.statistics;
    const uint64_t number = numbers_[ordinal];
    statistics.time_ns = static_cast<uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin_)
            .count());
    if (images.read(number, frame, error) != ImageFrames::Outcome::kFrame) {
      if (error.empty()) error = "frame " + std::to_string(number) + ": is not there any more";
      return false;
    }
    const SurfaceView view{frame.pixels.data(), static_cast<ptrdiff_t>(images.size().width) * 4,
                           images.size().width, images.size().height,
                           images.format(),     ByteOrder::kRgba};
    statistics.frame = number;
    statistics.readback_ns = frame.decode_ns;
    engine.seek(ordinal);
    engine.note_block_bits(wanted ? worker.pictures.bits_for(number) : nullptr);
    engine.process(view, statistics);
    if (!wanted) return true;
    const auto written = worker.pictures.write(statistics, view);
    if (!written) error = written.error().text;
    return static_cast<bool>(written);
  }

  const std::atomic<int>& stop_;
  const ImageFrames& images_;
  const std::vector<uint64_t>& numbers_;
  const RunOptions& options_;
  const std::string& pictures_path_;
  const size_t range_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::atomic<size_t> next_range_ = 0;
  std::atomic<bool> stopping_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Range> ranges_;
};

}  // namespace

bool run_frame_batch(const ImageFrames& images, const std::vector<uint64_t>& numbers,
                     const RunOptions& options, const std::string& pictures_path, uint32_t jobs,
                     const std::atomic<int>& stop, const std::function<bool(const FrameStatistics&)>& deliver,
                     std::string& error) {
  return FrameBatch(images, numbers, options, pictures_path, std::max(1u, jobs), stop)
      .run(std::max(1u, jobs), deliver, error);
}

}  // namespace tilepress
