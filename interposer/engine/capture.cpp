// Capture: what happens to a frame between the hook and the worker.
#include "interposer/engine/capture.h"

#include "interposer/engine/monotonic_clock.h"

#include <errno.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "tilepress/simd.h"

namespace tilepress {
namespace {

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> command;
  for (std::string argument; std::getline(file, argument, '\0');) command.push_back(argument);
  return command;
}

// The name it was started by. Not program_invocation_name, which a retracer sets to the name of its trace.
std::string program_name() {
  const auto* path = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  std::string name = path != nullptr ? path : "";
  name.erase(0, name.rfind('/') + 1);
  return name.empty() ? program_invocation_short_name : name;
}

std::string damage_text(const TilepressPresent& present) {
  std::string text;
  for (int32_t i = 0; present.damage != nullptr && i < 4 * present.damage_count; ++i)
    (text += i % 4 == 0 ? ';' : ' ') += std::to_string(present.damage[i]);
  return text.empty() ? text : text.substr(1);
}

constexpr uint32_t kNoWindow = ~0u;

}  // namespace

Capture::Capture(const TilepressHost& host) : host_(host), pid_(getpid()), times_(pid_) {
  std::string error;
  enabled_ = from_environment(options_, error) && !options_.output.empty();
  const char* wish = std::getenv("TILEPRESS_CAPTURE");
  counting_only_ = wish != nullptr && std::strcmp(wish, "off") == 0;
  if (const char* target = std::getenv("TILEPRESS_SIMD")) force_simd_target(target);  // unknown: the best one
  log_ = std::make_unique<ShimLog>(options_.log_file, options_.log_level);
  if (!error.empty()) log_->write(LogLevel::kError, error);
  start_ns_ = now_ns();
}

PresentSource* Capture::source_of(const TilepressPresent& present) {
  std::lock_guard lock(mutex_);
  for (const Source& known : sources_)
    if (known.real == present.real) return known.source.get();
  auto source =
      present.api == TILEPRESS_EGL ? make_egl_source(host_, present) : make_glx_source(host_, present);
  if (source == nullptr) log_->write(LogLevel::kError, "the GL library lacks functions to read frames back");
  sources_.push_back({present.real, present.api, std::move(source)});
  return sources_.back().source.get();
}

CaptureWorker* Capture::worker(const TilepressPresent& present, const PresentSource& source) {
  std::lock_guard lock(mutex_);
  if (CaptureWorker* known = worker_) return known;
  RunInfo info;
  info.command = command_line();
  info.program = program_name();
  info.pid = pid_;
  info.via = present.via;
  const GlStrings strings = source.strings();
  info.gl_vendor = strings.vendor;
  info.gl_renderer = strings.renderer;
  info.gl_version = strings.version;
  info.api = source.api();
  auto* made = new CaptureWorker(options_, info, counts_, *log_);
  if (!made->start()) {
    log_->write(LogLevel::kError, "no thread to capture with");
    enabled_ = false;
  }
  return worker_ = made;
}

void Capture::report(uint32_t surface, const std::string& reason) {
  if (registry_.first_report(surface))
    log_->write(LogLevel::kWarn, "surface " + std::to_string(surface) + ": " + reason);
}

Capture::Outcome Capture::take(TilepressPresent& present, PresentSource& source, uint64_t begin_ns,
                               uint32_t& window, CapturedFrame*& frame) {
  WindowKey key{};
  SurfaceShape shape;
  std::string reason;
  if (!source.describe(present, key, shape, reason)) {
    log_->write(LogLevel::kDebug, reason);
    return Outcome::kNotCaptured;
  }
  const SurfaceRegistry::Turn turn = registry_.turn(key, shape, begin_ns);
  window = turn.window;
  if (turn.forgotten) worker(present, source)->queue().submit_end_of(*turn.forgotten);
  if (!options_.takes(turn.frame)) return Outcome::kSkipped;
  if (!shape.format || !traits(*shape.format).modelled ||
      std::max(shape.width, shape.height) > kMaxSurfaceSide) {
    report(turn.surface, std::string("unsupported format") + (shape.format ? " " : "") +
                             std::string(shape.format ? traits(*shape.format).name : ""));
    return Outcome::kUnsupported;
  }
  const uint64_t wait_ns = now_ns();
  frame = worker(present, source)->queue().acquire(options_.on_full == OnFull::kBlock);
  if (frame == nullptr) return Outcome::kDropped;
  const uint64_t waited_ns = now_ns() - wait_ns;
  if (!source.read(present, shape, *frame, reason)) {
    report(turn.surface, "not captured: " + reason);
    worker_.load()->queue().release(frame);
    frame = nullptr;
    return Outcome::kNotCaptured;
  }
  frame->window = turn.window;
  frame->surface = turn.surface;
  frame->frame = turn.frame;
  frame->time_ns = begin_ns - start_ns_;
  frame->interval_ns = turn.interval_ns;
  frame->wait_ns = waited_ns;
  frame->damage = damage_text(present);
  frame->readback_ns = now_ns() - begin_ns - waited_ns;
  return Outcome::kTaken;
}

bool Capture::begin(TilepressPresent& present) {
  const uint64_t begin_ns = now_ns();
  const bool taken = !counting_only_ && begin_capture(present, begin_ns);
  present.ticket[3] = reinterpret_cast<void*>(uintptr_t{begin_ns});
  present.ticket[4] = reinterpret_cast<void*>(uintptr_t{now_ns() - begin_ns});
  return taken || times_.on();
}

void Capture::end(TilepressPresent& present, bool presented) {
  const uint64_t end_ns = now_ns();
  if (present.ticket[0] != nullptr) end_capture(present, presented);
  if (!times_.on() || !presented) return;
  const auto begin_ns = reinterpret_cast<uintptr_t>(present.ticket[3]);
  times_.note(present.surface, begin_ns, reinterpret_cast<uintptr_t>(present.ticket[4]) + now_ns() - end_ns);
}

bool Capture::begin_capture(TilepressPresent& present, uint64_t begin_ns) {
  const CaptureWorker* known = worker_;
  if (!enabled_ || (known != nullptr && !known->alive())) return false;
  PresentSource* source = source_of(present);
  if (source == nullptr) return false;
  uint32_t window = kNoWindow;
  CapturedFrame* frame = nullptr;
  const Outcome outcome = take(present, *source, begin_ns, window, frame);
  worker(present, *source);
  counts_.roads |= strcmp(present.via, "glvnd") == 0 ? kRoadGlvnd : kRoadPreload;
  if (!enabled_) return false;
  present.ticket[0] = reinterpret_cast<void*>(outcome);
  present.ticket[1] = reinterpret_cast<void*>(uintptr_t{window});
  present.ticket[2] = frame;
  return true;
}

void Capture::end_capture(TilepressPresent& present, bool presented) {
  const auto outcome = static_cast<Outcome>(reinterpret_cast<uintptr_t>(present.ticket[0]));
  const auto window = static_cast<uint32_t>(reinterpret_cast<uintptr_t>(present.ticket[1]));
  auto* frame = static_cast<CapturedFrame*>(present.ticket[2]);
  FrameQueue& queue = worker_.load()->queue();
  if (!presented) {
    if (frame != nullptr) queue.release(frame);
    return;
  }
  ++counts_.seen;
  if (window != kNoWindow) registry_.presented(window, reinterpret_cast<uintptr_t>(present.ticket[3]));
  switch (outcome) {
    case Outcome::kTaken:
      return queue.submit(frame);
    case Outcome::kSkipped:
      ++counts_.skipped;
      break;
    case Outcome::kDropped:
      ++counts_.dropped;
      break;
    case Outcome::kUnsupported:
      ++counts_.unsupported;
      break;
    case Outcome::kNotCaptured:
      ++counts_.not_captured;
      break;
  }
  queue.wake();
}

void Capture::contexts_going(uint32_t api, void* display) {
  std::lock_guard lock(mutex_);
  for (const Source& known : sources_)
    if (known.api == api && known.source != nullptr) known.source->release(display);
}

void Capture::surface_going(void* display, uintptr_t surface) {
  const auto window = registry_.forget({display, surface});
  CaptureWorker* known = worker_;
  if (window && known != nullptr) known->queue().submit_end_of(*window);
}

void Capture::finish() {
  if (CaptureWorker* known = worker_) known->finish();
}

}  // namespace tilepress
