// Live page: the state of a running capture, in a small file that the capture and its watchers map.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_directory.h"
#include "tilepress/statistics.h"

namespace tilepress {

constexpr uint32_t kLiveVersion = 3;
constexpr size_t kLiveSchemes = 16;        ///< further schemes are not shown
constexpr size_t kLiveNameBytes = 64;      ///< with the closing zero
constexpr const char* kLiveFile = "live";  ///< in the run directory, from the first frame until the run ends

/// Sums and the last frame of one scheme.
struct LiveScheme {
  char name[kLiveNameBytes];
  uint64_t raw_bits, moved_bits;              ///< over all measured frames
  uint64_t frame_raw_bits, frame_moved_bits;  ///< of the last frame
  uint64_t extra_bits, frame_extra_bits;      ///< further traffic, not in moved_bits
};

/// A snapshot of a capture. It has plain numbers only, because a watcher may be another build.
struct LiveState {
  char program[kLiveNameBytes];
  int64_t pid;
  uint64_t seen, captured, dropped, skipped, unsupported, not_captured;
  uint64_t queued, queue_depth;  ///< frames that wait for the worker, and the limit
  uint64_t frame, surface;       ///< the last frame
  uint64_t width, height;
  uint64_t time_ns;                 ///< when the program presented it, since the run began
  uint64_t readback_ns, encode_ns;  ///< of the last frame
  uint64_t readback_sum_ns, encode_sum_ns;
  double fvc_coverage, pixel_change;  ///< of the last frame
  uint64_t scheme_count;
  LiveScheme schemes[kLiveSchemes];
};

/// What the program has presented, or turned away from, so far. The program's threads raise these numbers, so
/// that they are right even if a signal kills the program and the capture together.
struct LiveCounts {
  std::atomic<uint64_t> seen, captured, dropped, skipped, unsupported, not_captured;
  RunCounts now() const { return {seen, captured, dropped, skipped, unsupported, not_captured}; }
};

/// The file's contents. The capture makes `sequence` odd while it changes `state`.
struct LivePage {
  uint64_t magic;  ///< bytes "TPLIVE\0\0"
  uint32_t version;
  uint32_t size;  ///< sizeof(LivePage)
  std::atomic<uint64_t> sequence;
  std::atomic<uint64_t> picture_requests;  ///< a LiveReader that wants pictures raises it regularly
  std::atomic<uint64_t> picture_error;     ///< errno of the last picture that failed, or 0
  LiveCounts presented, targets;
  LiveState state;
};
static_assert(std::atomic<uint64_t>::is_always_lock_free && sizeof(LiveState) % sizeof(uint64_t) == 0);

/// The capture's side. A page that cannot be made is no error: the run continues without one.
class LiveWriter {
 public:
  LiveWriter() = default;
  LiveWriter(const LiveWriter&) = delete;
  LiveWriter& operator=(const LiveWriter&) = delete;
  ~LiveWriter();
  void open(const std::string& run_path, const RunInfo& info, const RunOptions& options);
  /// Null without a page.
  LivePage* page() const { return page_; }
  /// Call after each frame. `totals`: the run's sums, in the order of the schemes.
  void update(const FrameStatistics& frame, const std::vector<SchemeStatistics>& totals,
              const RunCounts& counts, uint64_t queued, uint64_t queue_depth);
  const LiveState& state() const { return state_; }
  /// Whether a watcher asked for pictures since the last frame or in the two seconds before. A watcher that
  /// was killed stops asking, so nothing needs a cleanup. True at most ten times a second.
  bool picture_wanted();
  void set_picture_error(int error);
  /// Removes the file.
  void close();

 private:
  LivePage* page_ = nullptr;
  std::string path_;
  LiveState state_{};
  uint64_t requests_seen_ = 0, request_seen_ns_ = 0, picture_ns_ = 0;
};

/// The watcher's side. It maps the page read-only, so that it cannot disturb the capture, unless it asks for
/// pictures.
class LiveReader {
 public:
  LiveReader() = default;
  LiveReader(const LiveReader&) = delete;
  LiveReader& operator=(const LiveReader&) = delete;
  ~LiveReader();
  /// Fails if the run has no page of this version.
  Result<void> open(const std::string& run_path, bool asks_for_pictures = false);
  /// Copies a consistent state. False if there is none, because the writer died while it wrote.
  bool read(LiveState& out) const;
  /// The counts that the program's threads have raised. Zeros without a page.
  RunCounts presented() const;
  RunCounts targets() const;
  /// Asks for pictures (live_picture.h) for the next two seconds. Precondition: open() with
  /// `asks_for_pictures`.
  void ask_for_pictures();
  /// errno of the last picture that the capture could not write, or 0.
  int picture_error() const;

 private:
  LivePage* page_ = nullptr;
};

}  // namespace tilepress
