// Capture watch: the running capture that the window shows.
#pragma once

#include <chrono>
#include <string>

#include "live/capture_screen.h"
#include "tilepress/live_picture.h"

namespace tilepress {

class CaptureWatch {
 public:
  /// Looks for running captures below `folder`, a run directory or a folder of some.
  explicit CaptureWatch(std::string folder) : folder_(std::move(folder)) {}

  /// Asks for pictures while `wanted`, and reads what is new. Returns true if there is something new to show.
  bool refresh(bool wanted);
  /// Attaches to the next of the running captures, or to the same one if there is no other.
  void attach_next();

  bool attached() const { return reader_ != nullptr; }
  const std::string& folder() const { return folder_; }
  /// Why attaching to the last capture found failed, one line; empty if it did not.
  const std::string& error() const { return error_; }
  const WatchedCapture& capture() const { return capture_; }
  bool has_picture() const { return picture_.head.number > 0; }
  const LivePicture& picture() const { return picture_; }
  /// The errno of a picture that the capture could not write, or 0.
  int picture_error() const { return reader_ ? reader_->picture_error() : 0; }
  size_t index() const { return index_; }  ///< of `count` running captures
  size_t count() const { return count_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool attach(const std::string& path);
  void look();
  bool refresh_numbers();
  std::string folder_, error_;
  std::unique_ptr<LiveReader> reader_;
  WatchedCapture capture_;
  LivePicture picture_;
  Clock::time_point asked_at_{}, looked_at_{}, read_at_{};
  size_t index_ = 0, count_ = 0;
};

}  // namespace tilepress
