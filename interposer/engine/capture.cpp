// Capture: what happens to a frame between the hook and the worker.
#include "interposer/engine/capture.h"

#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/readback/target_watch.h"

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

}  // namespace

Capture::Capture(const TilepressHost& host) : host_(host), pid_(getpid()), times_(pid_) {
  const Result<void> read = from_environment(options_);
  enabled_ = read && !options_.output.empty();
  const char* wish = std::getenv("TILEPRESS_CAPTURE");
  counting_only_ = wish != nullptr && std::strcmp(wish, "off") == 0;
  if (const char* target = std::getenv("TILEPRESS_SIMD")) force_simd_target(target);  // unknown: the best one
  log_ = std::make_unique<ShimLog>(options_.log_file, options_.log_level);
  if (!read) log_->write(LogLevel::kError, read.error().text);
  readback_ = std::make_unique<ReadbackChoices>(options_.readback);
  start_ns_ = now_ns();
}

PresentSource* Capture::source_of(const TilepressPresent& present) {
  std::lock_guard lock(mutex_);
  for (const Source& known : sources_)
    if (known.real == present.real) return known.source.get();
  auto source = present.api == TILEPRESS_EGL   ? make_egl_source(host_, present, reader_)
                : present.api == TILEPRESS_GLX ? make_glx_source(host_, present, reader_)
                                               : make_osmesa_source(host_, present);
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
  info.via = present.road == TILEPRESS_ROAD_GLVND ? "glvnd" : "preload";
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

bool Capture::first_time(const std::string& reason) {
  std::lock_guard lock(mutex_);
  return told_.insert(reason).second;
}

Capture::Take Capture::take(const Shot& shot, CaptureWorker& worker) {
  Take take;
  take.role = shot.key.role;
  const SurfaceRegistry::Turn turn = registry_.turn(shot.key, shot.shape, shot.begin_ns);
  take.window = turn.window;
  take.begin_ns = shot.begin_ns;
  if (turn.forgotten) {
    worker.queue().submit_end_of(*turn.forgotten);
    readback_->forget(*turn.forgotten);
  }
  const auto ends_as = [&](Outcome outcome) {
    take.outcome = outcome;
    return take;
  };
  if (!options_.takes(turn.frame)) return ends_as(Outcome::kSkipped);
  const std::string of_origin = shot.origin != "window" ? shot.origin + ": " : "";
  const std::optional<PixelFormat> format = shot.shape.format;
  if (!format || !traits(*format).modelled ||
      std::max(shot.shape.width, shot.shape.height) > kMaxSurfaceSide) {
    std::string reason = of_origin + "unsupported format";
    if (format) reason.append(" ").append(traits(*format).name);
    report(turn.surface, reason);
    return ends_as(Outcome::kUnsupported);
  }
  if (worker.ended()) {
    report(turn.surface, "not captured: presented by an exit handler or destructor, after the capture ended");
    return ends_as(Outcome::kNotCaptured);
  }
  const uint64_t wait_ns = now_ns();
  take.frame = worker.queue().acquire(options_.on_full == OnFull::kBlock);
  if (take.frame == nullptr) return ends_as(Outcome::kDropped);
  const uint64_t waited_ns = now_ns() - wait_ns;
  CapturedFrame& frame = *take.frame;
  const uint64_t pixels = uint64_t{shot.shape.width} * shot.shape.height;
  const bool new_shape = shot.shape.resizable && turn.new_shape;
  const bool asked_to_be_late = shot.any_way && options_.readback == Readback::kAsync;
  const bool in_place = shot.software_window && (new_shape || !asked_to_be_late);
  frame.way = in_place       ? ReadWay::kInContext
              : shot.any_way ? readback_->way(turn.window, pixels)
                             : ReadWay::kSync;
  frame.partial = new_shape || shot.key.role == SurfaceRole::kTarget;
  frame.arrive = [&queue = worker.queue(), filled = take.frame](bool whole) { queue.arrived(filled, whole); };
  if (std::string reason; !shot.read(frame, reason)) {
    report(turn.surface, "not captured: " + of_origin + reason);
    worker.queue().release(take.frame);
    take.frame = nullptr;
    return ends_as(Outcome::kNotCaptured);
  }
  if (shot.any_way && !in_place) {
    const std::string choice = readback_->note(turn.window, frame);
    if (!choice.empty())
      log_->write(LogLevel::kInfo, "surface " + std::to_string(turn.surface) + ": " + choice);
  }
  frame.window = turn.window;
  frame.surface = turn.surface;
  frame.frame = turn.frame;
  frame.time_ns = shot.begin_ns - start_ns_;
  frame.interval_ns = turn.interval_ns;
  frame.wait_ns = waited_ns;
  frame.role = shot.key.role;
  frame.cause = shot.cause;
  frame.origin = shot.origin;
  frame.srgb = shot.shape.srgb;
  frame.damage = shot.damage;
  frame.readback_ns = now_ns() - shot.begin_ns - waited_ns;
  return ends_as(Outcome::kTaken);
}

bool Capture::is_capturing() const {
  const CaptureWorker* known = worker_;
  return enabled_ && !counting_only_ && (known == nullptr || known->alive());
}

bool Capture::begin(TilepressPresent& present) {
  const uint64_t begin_ns = now_ns();
  const bool taken = !counting_only_ && begin_capture(present, begin_ns);
  present.ticket.begin_ns = begin_ns;
  present.ticket.hook_ns = now_ns() - begin_ns;
  return taken || times_.on();
}

void Capture::end(TilepressPresent& present, bool presented) {
  const uint64_t end_ns = now_ns();
  if (present.ticket.outcome != 0) end_capture(present, presented);
  if (!times_.on() || !presented) return;
  times_.note(present.surface, present.ticket.begin_ns, present.ticket.hook_ns + now_ns() - end_ns);
}

bool Capture::begin_capture(TilepressPresent& present, uint64_t begin_ns) {
  if (!is_capturing()) return false;
  PresentSource* source = source_of(present);
  if (source == nullptr) return false;
  if (present.api == TILEPRESS_OSMESA && !source->find_current(present, FramebufferUse::kDraw))
    return false;  // another API's, then
  if (options_.all_targets && source->context() != nullptr) {
    take_attachments(present, *source, targets_left(source->gl()), FramebufferUse::kDraw,
                     SurfaceRole::kTarget, "target");
    begin_ns = now_ns();
  }
  Shot shot;
  shot.begin_ns = begin_ns;
  shot.damage = damage_text(present);
  if (present.api == TILEPRESS_OSMESA) shot.origin = "buffer";
  Take taken;
  if (std::string reason; !source->describe(present, shot.key, shot.shape, reason)) {
    // A void call counts as a present whatever it does.
    const bool told = present.api != TILEPRESS_GLX || !first_time(reason);
    log_->write(told ? LogLevel::kDebug : LogLevel::kWarn, "not captured: " + reason);
  } else if (CaptureWorker* made = worker(present, *source)) {
    shot.any_way = true;
    shot.software_window = shot.shape.resizable && source->draws_in_software();
    shot.read = [&](CapturedFrame& frame, std::string& why) {
      return source->read(present, shot.shape, frame, why);
    };
    taken = take(shot, *made);
  }
  worker(present, *source);
  counts_.roads |= 1u << present.road;
  if (!enabled_) return false;
  present.ticket.outcome = static_cast<uint32_t>(taken.outcome);
  present.ticket.window = taken.window;
  present.ticket.frame = taken.frame;
  return true;
}

void Capture::end_capture(TilepressPresent& present, bool presented) {
  Take taken;
  taken.outcome = static_cast<Outcome>(present.ticket.outcome);
  taken.window = present.ticket.window;
  taken.frame = static_cast<CapturedFrame*>(present.ticket.frame);
  taken.begin_ns = present.ticket.begin_ns;
  if (presented)
    commit(taken);
  else if (taken.frame != nullptr)
    worker_.load()->queue().release(taken.frame);
}

void Capture::commit(const Take& taken) {
  RoleCounts& counts = counts_.of(taken.role);
  FrameQueue& queue = worker_.load()->queue();
  counts.raise(&LiveCounts::seen);
  if (taken.window != Take().window) registry_.presented(taken.window, taken.begin_ns, taken.triggered);
  switch (taken.outcome) {
    case Outcome::kTaken:
      queue.submit(taken.frame);
      break;
    case Outcome::kSkipped:
      counts.raise(&LiveCounts::skipped);
      break;
    case Outcome::kDropped:
      counts.raise(&LiveCounts::dropped);
      break;
    case Outcome::kUnsupported:
      counts.raise(&LiveCounts::unsupported);
      break;
    case Outcome::kNotCaptured:
      counts.raise(&LiveCounts::not_captured);
      break;
  }
  if (taken.outcome != Outcome::kTaken) queue.wake();
  worker_.load()->presented();
}

void Capture::contexts_going(uint32_t api, void* display, void* context) {
  {
    std::lock_guard lock(mutex_);
    for (const Source& known : sources_)
      if (known.api == api && known.source != nullptr) known.source->release(display);
  }
  if (context == nullptr) return;
  forget_targets(context);
  if (api == TILEPRESS_OSMESA) surface_going(context, 0);
}

void Capture::forget_targets(const void* context, uintptr_t image, uintptr_t mask) {
  CaptureWorker* known = worker_;
  for (const uint32_t window : registry_.forget_targets(context, image, mask))
    if (known != nullptr) known->queue().submit_end_of(window);
}

void Capture::surface_going(void* display, uintptr_t surface) {
  const auto window = registry_.forget({display, surface});
  CaptureWorker* known = worker_;
  if (!window) return;
  readback_->forget(*window);
  if (known != nullptr) known->queue().submit_end_of(*window);
  std::lock_guard lock(mutex_);
  for (const Source& source : sources_)
    if (source.source != nullptr) source.source->trim(display);
}

void Capture::finish() {
  if (CaptureWorker* known = worker_) known->finish();
}

}  // namespace tilepress
