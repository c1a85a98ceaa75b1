// Presenting: keeps errno and cancellation away from the program's sight while the engine works.
#include "presenting.h"

#include <errno.h>
#include <pthread.h>
#include <stddef.h>

#include "current_drawables.h"
#include "engine_loader.h"
#include "session_file.h"

void* (*tp_driver_lookup[TILEPRESS_API_COUNT])(const char* name);

// Depth of presenting calls on this thread. A driver or another shim may present through a hooked function.
static __thread int depth __attribute__((tls_model("initial-exec")));

bool tp_presenting(struct TilepressPresent* present) {
  if (depth > 0 || present->real == NULL) return false;
  int cancel_state;
  const int saved = errno;
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
  depth = 1;
  present->via = tp_via;
  present->look_up = tp_driver_lookup[present->api];
  // There every library is looked up at once, used or not: what tells is the call.
  if (present->look_up != NULL)
    tp_session_note(present->api == TILEPRESS_EGL ? "eglSwapBuffers" : "glXSwapBuffers", tp_via);
  const struct TilepressEngine* engine = tp_engine();
  const bool taken = engine != NULL && engine->begin(present) != 0;
  depth = taken ? 1 : 0;
  pthread_setcancelstate(cancel_state, NULL);
  errno = saved;
  return taken;
}

void tp_presented(struct TilepressPresent* present, bool success) {
  int cancel_state;
  const int saved = errno;
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
  tp_loaded_engine()->end(present, success);
  depth = 0;
  pthread_setcancelstate(cancel_state, NULL);
  errno = saved;
}

void tp_gl_called(struct TilepressGlCall* call) {
  if (depth > 0) return;
  int cancel_state;
  const int saved = errno;
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
  depth = 1;
  call->via = tp_via;
  call->context_destroyed = tp_current_context_is_destroyed();
  for (int api = 0; api < TILEPRESS_API_COUNT; ++api) call->look_up[api] = tp_driver_lookup[api];
  const struct TilepressEngine* engine = tp_engine();
  if (engine != NULL) engine->gl_call(call);
  depth = 0;
  pthread_setcancelstate(cancel_state, NULL);
  errno = saved;
}

uint8_t* tp_gl_drawn_mark(void) {
  const int saved = errno;
  const struct TilepressEngine* engine = tp_engine();
  uint8_t* mark = engine != NULL ? engine->drawn_mark() : NULL;
  errno = saved;
  return mark;
}

void tp_contexts_going(uint32_t api, void* display, void* context) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine == NULL || depth > 0) return;
  const int saved = errno;
  engine->contexts_going(api, display, context);
  errno = saved;
}

void tp_surface_going(void* display, uintptr_t surface) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine == NULL || depth > 0) return;
  const int saved = errno;
  engine->surface_going(display, surface);
  errno = saved;
}
