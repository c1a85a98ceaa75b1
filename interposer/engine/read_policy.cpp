// Read policy: the kind of window decides first, then the user's option, then the probe. The probe compares
// medians, because single frames wait for other things too.
#include "interposer/engine/read_policy.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepress {

static uint64_t median(std::vector<uint64_t> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

ReadWay ReadbackProbe::next() const {
  switch (state_) {
    case State::kBoth:
      return ReadWay::kBoth;
    case State::kTrial:
    case State::kChosenAsync:
      return ReadWay::kAsync;
    default:
      return ReadWay::kSync;
  }
}

bool ReadbackProbe::settle(State state) {
  state_ = state;
  passed_over_ = 0;
  return state == State::kChosenSync || state == State::kChosenAsync;
}

bool ReadbackProbe::pays(const std::vector<uint64_t>& buffered_ns) const {
  const uint64_t sync = median(sync_ns_), buffered = median(buffered_ns);
  return buffered * kFactor <= sync && buffered + kMarginNs <= sync;
}

bool ReadbackProbe::note(ReadWay way, uint64_t cost_ns, uint64_t buffered_cost_ns) {
  if (state_ == State::kChosenSync || state_ == State::kChosenAsync) return false;
  // The source took another way than it was given: there is no choice.
  if (way != next() || (way == ReadWay::kBoth && buffered_cost_ns == 0)) return settle(State::kChosenSync);
  switch (state_) {
    case State::kSync:
      if (++passed_over_ <= kWarmUp) return false;
      sync_ns_.push_back(cost_ns);
      return sync_ns_.size() == kSamples && settle(State::kBoth);
    case State::kBoth:
      if (++passed_over_ == 1) return false;  // the first one makes the buffer, and may compile something
      buffered_ns_.push_back(buffered_cost_ns);
      if (buffered_ns_.size() < kSamples) return false;
      return settle(pays(buffered_ns_) ? State::kTrial : State::kChosenSync);
    case State::kTrial:
      if (++passed_over_ == 1) return false;  // the first one makes the twin context
      trial_ns_.push_back(cost_ns);
      if (trial_ns_.size() < kSamples) return false;
      return settle(pays(trial_ns_) ? State::kChosenAsync : State::kChosenSync);
    default:
      return false;
  }
}

std::string ReadbackProbe::text() const {
  const bool async = state_ == State::kChosenAsync || state_ == State::kTrial;
  const auto ms = [](const std::vector<uint64_t>& times) {
    return fmt::format("{:.3f} ms", static_cast<double>(median(times)) / 1e6);
  };
  if (buffered_ns_.empty()) return "pixel buffers cannot be used: synchronous reads";
  return "synchronous reads " + ms(sync_ns_) + ", into pixel buffers " + ms(buffered_ns_) +
         (trial_ns_.empty() ? "" : ", on trial " + ms(trial_ns_)) +
         (async ? ": asynchronous" : ": synchronous");
}

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
