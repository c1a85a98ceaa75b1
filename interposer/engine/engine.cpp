// Engine: the C face of the capture, with one Capture per process id. No exception leaves this file.
#include <unistd.h>

#include <atomic>
#include <cstdlib>

#include "interposer/engine/capture.h"
#include "interposer/engine/own_calls.h"
#include "interposer/engine/readback/target_watch.h"

namespace tilepress {
namespace {

TilepressHost host;
std::atomic<Capture*> current{nullptr};

// The capture of this process. After a fork the child finds its parent's capture: neither its worker nor the
// threads that may hold its locks exist here. The child leaves that capture as it is and makes its own.
Capture* capture_of_this_process() {
  Capture* known = current.load(std::memory_order_acquire);
  if (known != nullptr && known->pid() == getpid()) return known;
  auto* fresh = new Capture(host);
  if (current.compare_exchange_strong(known, fresh, std::memory_order_acq_rel)) return fresh;
  delete fresh;
  return known;
}

/// Lets no exception out.
template <typename Work>
void guard(const Work& work) {
  try {
    work();
  } catch (...) {
  }
}

int begin(TilepressPresent* present) {
  if (inside_engine) return 0;
  bool taken = false;
  inside_engine = true;
  guard([&] { taken = capture_of_this_process()->begin(*present); });
  return inside_engine = taken;
}

void end(TilepressPresent* present, int presented) {
  guard([&] { capture_of_this_process()->end(*present, presented != 0); });
  inside_engine = false;
}

// Returns null if this process has captured nothing.
Capture* known_capture() {
  Capture* known = current.load(std::memory_order_acquire);
  return known != nullptr && known->pid() == getpid() ? known : nullptr;
}

// Does nothing on a thread that is inside the engine already.
template <typename Work>
void run_inside(const Work& work) {
  if (inside_engine) return;
  inside_engine = true;
  guard(work);
  inside_engine = false;
}

void gl_call(const TilepressGlCall* call) {
  run_inside([&] { capture_of_this_process()->gl_call(*call); });
}

void contexts_going(uint32_t api, void* display, void* context) {
  run_inside([&] {
    if (Capture* known = known_capture()) known->contexts_going(api, display, context);
  });
}

void surface_going(void* display, uintptr_t surface) {
  if (inside_engine) return;
  guard([&] {
    if (Capture* known = known_capture()) known->surface_going(display, surface);
  });
}

void finish() {
  guard([] {
    if (Capture* known = known_capture()) known->finish();
  });
}

constexpr TilepressEngine kEngine = {TILEPRESS_ENGINE_VERSION, begin,         end,   gl_call, drawn_mark,
                                     contexts_going,           surface_going, finish};

}  // namespace
}  // namespace tilepress

extern "C" __attribute__((visibility("default"))) const TilepressEngine* tilepress_engine(
    const TilepressHost* host) {
  if (host == nullptr || host->version != TILEPRESS_ENGINE_VERSION) return nullptr;
  tilepress::host = *host;
  // Exit handlers run from the last to the first, and before all destructors: the libraries that the engine
  // calls are still whole then. Frames that are presented later are counted and not read.
  std::atexit([] { tilepress::finish(); });
  at_quick_exit([] { tilepress::finish(); });
  return &tilepress::kEngine;
}
