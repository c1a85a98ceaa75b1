// Frame taker: what happens to a frame between the hook and the worker.
#include "interposer/engine/frame_taker.h"

#include <algorithm>

#include "interposer/system_calls.h"

namespace tilepress {
namespace {

/// The count that a frame raises when it is not handed to the worker, by its outcome less kSkipped.
constexpr RoleCounts::Count kCounts[] = {&LiveCounts::skipped, &LiveCounts::dropped, &LiveCounts::unsupported,
                                         &LiveCounts::not_captured};

/// Names the image in a line of the log. A window needs no name beside its surface number.
std::string subject_of(const Shot& shot) {
  return shot.origin != "window" ? shot.origin + ": " : "";
}

}  // namespace

Take FrameTaker::take(const Shot& shot, CaptureWorker& worker) {
  const SurfaceRegistry::Turn turn = registry_.turn(shot.key, shot.shape, shot.begin_ns);
  Take take{Outcome::kTaken, turn.window, nullptr, shot.begin_ns, shot.key.role};
  if (turn.forgotten) {
    worker.queue().submit_end_of(*turn.forgotten);
    policy_.forget(*turn.forgotten);
  }
  if (const std::optional<Outcome> refused = refusal(shot, turn, worker)) {
    take.outcome = *refused;
    return take;
  }
  const uint64_t wait_ns = now_ns();
  CapturedFrame* frame = worker.queue().acquire(options_.on_full == OnFull::kBlock);
  if (frame == nullptr) {
    take.outcome = Outcome::kDropped;
    return take;
  }
  frame->wait_ns = now_ns() - wait_ns;
  frame->arrive = [&queue = worker.queue(), frame](bool whole) { queue.arrived(frame, whole); };
  if (const Result<void> done = read(shot, turn, *frame); !done) {
    report(turn.surface, "not captured: " + subject_of(shot) + done.error().text);
    worker.queue().release(frame);
    take.outcome = Outcome::kNotCaptured;
    return take;
  }
  fill_in(shot, turn, *frame);
  take.frame = frame;
  return take;
}

std::optional<Outcome> FrameTaker::refusal(const Shot& shot, const SurfaceRegistry::Turn& turn,
                                           const CaptureWorker& worker) {
  if (!options_.takes(turn.frame)) return Outcome::kSkipped;
  const std::optional<PixelFormat> format = shot.shape.format;
  if (!format || !traits(*format).modelled ||
      std::max(shot.shape.width, shot.shape.height) > kMaxSurfaceSide) {
    std::string reason = subject_of(shot) + "unsupported format";
    if (format) reason.append(" ").append(traits(*format).name);
    report(turn.surface, reason);
    return Outcome::kUnsupported;
  }
  if (worker.ended()) {
    report(turn.surface, "not captured: presented by an exit handler or destructor, after the capture ended");
    return Outcome::kNotCaptured;
  }
  return std::nullopt;
}

Result<void> FrameTaker::read(const Shot& shot, const SurfaceRegistry::Turn& turn, CapturedFrame& frame) {
  const ReadCase read{turn.window, uint64_t{shot.shape.width} * shot.shape.height, shot.may_be_late,
                      shot.software_window, shot.shape.resizable && turn.new_shape};
  frame.way = policy_.way(read);
  frame.partial = read.new_shape || shot.key.role == SurfaceRole::kTarget;
  if (Result<void> done = shot.read(frame); !done) return done;
  if (const std::string choice = policy_.note(read, frame); !choice.empty())
    log_.info("surface " + std::to_string(turn.surface) + ": " + choice);
  return {};
}

void FrameTaker::fill_in(const Shot& shot, const SurfaceRegistry::Turn& turn, CapturedFrame& frame) const {
  frame.window = turn.window;
  frame.surface = turn.surface;
  frame.frame = turn.frame;
  frame.time_ns = shot.begin_ns - start_ns_;
  frame.interval_ns = turn.interval_ns;
  frame.role = shot.key.role;
  frame.cause = shot.cause;
  frame.origin = shot.origin;
  frame.srgb = shot.shape.srgb;
  frame.damage = shot.damage;
  frame.readback_ns = now_ns() - shot.begin_ns - frame.wait_ns;
}

Take FrameTaker::miss(const Shot& shot, const Error& reason) {
  const SurfaceRegistry::Turn turn = registry_.turn(shot.key, shot.shape, shot.begin_ns);
  report(turn.surface, "not captured: " + shot.origin + ": " + reason.text);
  return {Outcome::kNotCaptured, turn.window, nullptr, shot.begin_ns, shot.key.role};
}

void FrameTaker::commit(const Take& take, CaptureWorker& worker) {
  RoleCounts& counts = counts_.of(take.role);
  counts.raise(&LiveCounts::seen);
  if (take.window != Take::kNoWindow) registry_.presented(take.window, take.begin_ns, take.triggered);
  if (take.outcome == Outcome::kTaken) {
    worker.queue().submit(take.frame);
  } else {
    counts.raise(kCounts[static_cast<uint32_t>(take.outcome) - static_cast<uint32_t>(Outcome::kSkipped)]);
    worker.queue().wake();
  }
  worker.presented();
}

void FrameTaker::discard(const Take& take, CaptureWorker& worker) {
  if (take.frame != nullptr) worker.queue().release(take.frame);
}

void FrameTaker::report(uint32_t surface, const std::string& reason) {
  if (registry_.first_report(surface)) log_.warn("surface " + std::to_string(surface) + ": " + reason);
}

}  // namespace tilepress
