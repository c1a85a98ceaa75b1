// Capture: wires the rooms that a frame passes.
#include "interposer/engine/capture.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "interposer/system_calls.h"
#include "tilepress/simd.h"

namespace tilepress {
namespace {

TilepressTicket ticket_of(const Take& take) {
  return {static_cast<uint32_t>(take.outcome), take.window, take.frame, 0, 0};
}

Take take_of(const TilepressTicket& ticket) {
  return {static_cast<Outcome>(ticket.outcome), ticket.window, static_cast<CapturedFrame*>(ticket.frame),
          ticket.begin_ns};
}

bool is_off(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::strcmp(value, "off") == 0;
}

}  // namespace

Capture::Capture(const TilepressHost& host)
    : pid_(getpid()),
      valid_(from_environment(options_)),
      counting_only_(is_off("TILEPRESS_CAPTURE")),
      log_(options_.log_file, options_.log_level),
      times_(pid_),
      policy_(options_.readback),
      sources_(host, options_.readback == Readback::kInContext, log_),
      run_(options_, pid_, log_),
      taker_(options_, registry_, policy_, run_.counts(), log_, now_ns()),
      targets_(registry_, sources_, run_, taker_, log_) {
  if (const char* target = std::getenv("TILEPRESS_SIMD")) force_simd_target(target);  // unknown: the best one
  if (!valid_) log_.error(valid_.error().text);
}

bool Capture::is_capturing() const {
  const CaptureWorker* worker = run_.worker_if_started();
  return valid_ && !options_.output.empty() && !counting_only_ && (worker == nullptr || worker->alive());
}

bool Capture::begin(TilepressPresent& present) {
  const uint64_t begin_ns = now_ns();
  const bool taken = is_capturing() && take_present(present, begin_ns);
  present.ticket.begin_ns = begin_ns;
  present.ticket.hook_ns = now_ns() - begin_ns;
  return taken || times_.on();
}

bool Capture::take_present(TilepressPresent& present, uint64_t begin_ns) {
  PresentSource* source = sources_.of(present);
  if (source == nullptr) return false;
  if (present.api == TILEPRESS_OSMESA && !source->find_current(present, FramebufferUse::kDraw))
    return false;  // the window belongs to another API, whose own call comes next
  CaptureWorker* worker = run_.worker(present, *source);
  if (worker == nullptr) return false;
  if (options_.all_targets) {
    targets_.take_targets(present, *source);
    begin_ns = now_ns();
  }
  const Result<Drawable> drawable = source->describe(present);
  const ShotBuilder shots(*source, present);
  present.ticket = ticket_of(drawable ? taker_.take(shots.of_present(*drawable, begin_ns), *worker)
                                      : not_described(present, drawable.error()));
  return true;
}

// glXSwapBuffers returns nothing, so each of its calls counts as a present, and the log warns once per
// reason. A failing eglSwapBuffers returns an error to the program.
Take Capture::not_described(const TilepressPresent& present, const Error& reason) {
  const std::string line = "not captured: " + reason.text;
  bool warns = present.api == TILEPRESS_GLX;
  if (warns) {
    const std::lock_guard lock(mutex_);
    warns = warned_.insert(line).second;
  }
  warns ? log_.warn(line) : log_.debug(line);
  return {};
}

void Capture::end(TilepressPresent& present, bool presented) {
  const uint64_t end_ns = now_ns();
  const TilepressTicket& ticket = present.ticket;
  CaptureWorker* worker = run_.worker_if_started();
  if (ticket.outcome != 0 && worker != nullptr) {
    if (presented)
      taker_.commit(take_of(ticket), *worker);
    else
      taker_.discard(take_of(ticket), *worker);
  }
  if (times_.on() && presented)
    times_.note(present.surface, ticket.begin_ns, ticket.hook_ns + now_ns() - end_ns);
}

void Capture::gl_call(const TilepressGlCall& call) {
  if (is_capturing()) targets_.gl_call(call);
}

void Capture::contexts_going(uint32_t api, void* display, void* context) {
  sources_.release(api, display);
  if (context == nullptr) return;
  targets_.forget(context);
  if (api == TILEPRESS_OSMESA) surface_going(context, 0);
}

void Capture::surface_going(void* display, uintptr_t surface) {
  const std::optional<uint32_t> window = registry_.forget({display, surface});
  if (!window) return;
  policy_.forget(*window);
  if (CaptureWorker* worker = run_.worker_if_started()) worker->queue().submit_end_of(*window);
  sources_.trim(display);
}

void Capture::finish() {
  if (CaptureWorker* worker = run_.worker_if_started()) worker->finish();
}

}  // namespace tilepress
