// Read policy: the kind of window decides first, then the user's option, then the probe.
#include "interposer/engine/read_policy.h"

namespace tilepress {

bool ReadPolicy::in_place(const ReadCase& read) const {
  const bool late = read.may_be_late && wish_ == Readback::kAsync;
  return read.software_window && (read.new_shape || !late);
}

ReadWay ReadPolicy::way(const ReadCase& read) {
  if (in_place(read)) return ReadWay::kInContext;
  if (!read.may_be_late || wish_ == Readback::kSync || wish_ == Readback::kInContext) return ReadWay::kSync;
  if (wish_ == Readback::kAsync) return ReadWay::kAsync;
  const std::lock_guard lock(mutex_);
  Choice& choice = choices_[read.window];
  if (choice.pixels == 0 || read.pixels > 2 * choice.pixels || 2 * read.pixels < choice.pixels)
    choice = {ReadbackProbe(), read.pixels};
  return choice.probe.next();
}

std::string ReadPolicy::note(const ReadCase& read, const CapturedFrame& frame) {
  if (wish_ != Readback::kAuto || !read.may_be_late || in_place(read)) return "";
  const std::lock_guard lock(mutex_);
  const auto found = choices_.find(read.window);
  if (found == choices_.end()) return "";
  const uint64_t buffered_ns = frame.buffered_ns > 0 ? frame.bind_ns + frame.buffered_ns : 0;
  const bool settled = found->second.probe.note(frame.way, frame.bind_ns + frame.read_ns, buffered_ns);
  return settled ? found->second.probe.text() : "";
}

void ReadPolicy::forget(uint32_t window) {
  if (wish_ != Readback::kAuto) return;
  const std::lock_guard lock(mutex_);
  choices_.erase(window);
}

}  // namespace tilepress
