// Presenting: saves errno and disables cancellation while the engine works.
#include "presenting.h"

#include <pthread.h>
#include <stddef.h>

#include "c_library.h"
#include "current_drawables.h"
#include "engine_loader.h"
#include "session_file.h"

static uint32_t road = TILEPRESS_ROAD_PRELOAD;
static void* (*driver_lookup[TILEPRESS_API_COUNT])(const char* name);

// 1 inside a presenting call of this thread: a driver or another shim may present through a hooked function.
static __thread int depth __attribute__((tls_model("initial-exec")));

// Programs of the thread sanitizer define these. The sanitizer does not see how the driver's threads
// synchronize. Without these calls it reports races in the driver, and the program ends with the sanitizer's
// status.
#define WEAK __attribute__((weak))
extern WEAK void AnnotateIgnoreReadsBegin(const char* file, int line);
extern WEAK void AnnotateIgnoreReadsEnd(const char* file, int line);
extern WEAK void AnnotateIgnoreWritesBegin(const char* file, int line);
extern WEAK void AnnotateIgnoreWritesEnd(const char* file, int line);

static void ignore_races(bool begin) {
  void (*const reads)(const char*, int) = begin ? AnnotateIgnoreReadsBegin : AnnotateIgnoreReadsEnd;
  void (*const writes)(const char*, int) = begin ? AnnotateIgnoreWritesBegin : AnnotateIgnoreWritesEnd;
  if (reads != NULL) reads(__FILE__, __LINE__);
  if (writes != NULL) writes(__FILE__, __LINE__);
}

// What the engine must leave as it is.
struct thread_state {
  int error, cancel_state;
};

// Both require that the C library has been found.
static struct thread_state save_thread(void) {
  const struct tp_c_library* library = tp_c_library();
  struct thread_state state = {*library->errno_location(), 0};
  library->pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &state.cancel_state);
  ignore_races(true);
  return state;
}

static void restore_thread(struct thread_state state) {
  const struct tp_c_library* library = tp_c_library();
  int disabled;
  ignore_races(false);
  library->pthread_setcancelstate(state.cancel_state, &disabled);
  *library->errno_location() = state.error;
}

void tp_come_through_glvnd(enum TilepressApi api, void* (*look_up)(const char* name)) {
  road = TILEPRESS_ROAD_GLVND;
  driver_lookup[api] = look_up;
}

bool tp_presenting(struct TilepressPresent* present) {
  if (depth > 0 || present->real == NULL || tp_c_library() == NULL) return false;
  const struct thread_state state = save_thread();
  depth = 1;
  present->road = road;
  present->look_up = driver_lookup[present->api];
  // libglvnd looks up every name at once, used or not. So the call is noted, not the lookup.
  if (present->look_up != NULL)
    tp_session_note(present->api == TILEPRESS_EGL ? TP_ENTRY_eglSwapBuffers : TP_ENTRY_glXSwapBuffers,
                    TP_WAY_GLVND);
  const struct TilepressEngine* engine = tp_engine();
  const bool taken = engine != NULL && engine->begin(present) != 0;
  depth = taken ? 1 : 0;
  restore_thread(state);
  return taken;
}

void tp_presented(struct TilepressPresent* present, bool success) {
  const struct thread_state state = save_thread();
  tp_loaded_engine()->end(present, success);
  depth = 0;
  restore_thread(state);
}

void tp_gl_called(struct TilepressGlCall* call) {
  if (depth > 0 || tp_c_library() == NULL) return;
  const struct thread_state state = save_thread();
  depth = 1;
  call->road = road;
  call->context_destroyed = tp_current_context_is_destroyed();
  for (int api = 0; api < TILEPRESS_API_COUNT; ++api) call->look_up[api] = driver_lookup[api];
  const struct TilepressEngine* engine = tp_engine();
  if (engine != NULL) engine->gl_call(call);
  depth = 0;
  restore_thread(state);
}

uint8_t* tp_gl_drawn_mark(void) {
  if (tp_c_library() == NULL) return NULL;
  const struct thread_state state = save_thread();
  const struct TilepressEngine* engine = tp_engine();
  uint8_t* mark = engine != NULL ? engine->drawn_mark() : NULL;
  restore_thread(state);
  return mark;
}

void tp_contexts_going(uint32_t api, void* display, void* context) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine == NULL || depth > 0) return;
  const struct thread_state state = save_thread();
  engine->contexts_going(api, display, context);
  restore_thread(state);
}

void tp_surface_going(void* display, uintptr_t surface) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine == NULL || depth > 0) return;
  const struct thread_state state = save_thread();
  engine->surface_going(display, surface);
  restore_thread(state);
}
