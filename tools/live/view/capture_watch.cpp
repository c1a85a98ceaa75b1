// Capture watch: asks for pictures twice a second. A capture stops making them two seconds after the last
// request.
#include "live/view/capture_watch.h"

#include <algorithm>

#include "live/running_captures.h"

namespace tilepress {

constexpr std::chrono::milliseconds kAskPeriod{500}, kLookPeriod{500}, kNumbersPeriod{500};

bool CaptureWatch::attach(const std::string& path) {
  auto reader = std::make_unique<LiveReader>();
  WatchedCapture capture;
  if (const auto opened = reader->open(path, true); !opened) return error_ = opened.error().text, false;
  if (!reader->read(capture.now)) return false;
  error_.clear();
  capture.path = path;
  reader_ = std::move(reader);
  capture_ = capture;
  picture_ = LivePicture{};
  asked_at_ = Clock::time_point{};
  read_at_ = Clock::now();
  return true;
}

void CaptureWatch::look() {
  const auto paths = find_running_captures({folder_});
  count_ = paths.size();
  if (attached()) {
    const auto found = std::find(paths.begin(), paths.end(), capture_.path);
    index_ = static_cast<size_t>(found - paths.begin());
    return;
  }
  for (size_t i = 0; i < paths.size() && !attached(); ++i)
    if (attach(paths[i])) index_ = i;
}

void CaptureWatch::attach_next() {
  const auto paths = find_running_captures({folder_});
  const auto found = std::find(paths.begin(), paths.end(), capture_.path);
  const size_t begin = found == paths.end() ? 0 : static_cast<size_t>(found - paths.begin()) + 1;
  for (size_t i = 0; i < paths.size(); ++i)
    if (attach(paths[(begin + i) % paths.size()])) break;
  looked_at_ = Clock::time_point{};
}

bool CaptureWatch::refresh_numbers() {
  const auto now = Clock::now();
  const bool ended = !capture_runs(capture_.path);
  const bool news = ended != capture_.ended;
  capture_.ended = ended;
  if (now - read_at_ < kNumbersPeriod) return news;
  LiveState state{};
  if (!reader_->read(state)) return news;
  capture_.elapsed_s = std::chrono::duration<double>(now - read_at_).count();
  capture_.before = capture_.now;
  capture_.now = state;
  read_at_ = now;
  return true;
}

bool CaptureWatch::refresh(bool wanted) {
  const auto now = Clock::now();
  bool news = false;
  if (now - looked_at_ >= kLookPeriod) {
    const bool before = attached();
    look();
    looked_at_ = now;
    news = attached() != before;
  }
  if (!attached()) return news;
  news |= refresh_numbers();
  if (!wanted) return news;
  if (now - asked_at_ >= kAskPeriod) {
    reader_->ask_for_pictures();
    asked_at_ = now;
  }
  return read_live_picture(capture_.path, picture_) || news;
}

}  // namespace tilepress
