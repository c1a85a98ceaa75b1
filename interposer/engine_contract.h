// Engine contract: what the preloaded library and the engine it loads know of each other. C, no dependency.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TILEPRESS_ENGINE_VERSION = 4 };

enum TilepressApi { TILEPRESS_EGL, TILEPRESS_GLX };

// A presenting call, before it is forwarded. The first part is filled by the hook.
struct TilepressPresent {
  uint32_t api;       // enum TilepressApi
  void* real;         // the function the call is forwarded to
  void* display;      // EGLDisplay or Display*
  uintptr_t surface;  // EGLSurface or GLXDrawable
  // x, y, width, height of each damage rectangle, origin at the bottom left; NULL = the whole surface
  const int32_t* damage;
  int32_t damage_count;
  const char* via;                     // road of the call, as in run.json
  void* (*look_up)(const char* name);  // the driver's functions where no public library answers; NULL else
  void* ticket[6];                     // the engine's own, from begin to end
};

struct TilepressEngine {
  uint32_t version;
  // Takes the frame that `present` is about to present. Returns 0 if end must not be called. Leaves the
  // thread's context, its GL and EGL state and errno as they are. Never fails visibly.
  int (*begin)(struct TilepressPresent* present);
  // The presenting call has returned; `presented` = it succeeded. Calls neither GL nor EGL.
  void (*end)(struct TilepressPresent* present, int presented);
  // The program is about to destroy contexts of `display`: ours on it go first.
  void (*contexts_going)(uint32_t api, void* display);
  // The program is about to destroy an EGL surface: one that is made later with the same handle is another.
  void (*surface_going)(void* display, uintptr_t surface);
  // The process is about to end: every frame taken is written out. May be called more than once.
  void (*finish)(void);
};

// What the engine may use of the library that loads it.
struct TilepressHost {
  uint32_t version;
  void* (*dlsym)(void* handle, const char* name);  // the real one
};

// The one symbol the engine exports. NULL if the versions do not fit.
typedef const struct TilepressEngine* (*TilepressEngineEntry)(const struct TilepressHost* host);
const struct TilepressEngine* tilepress_engine(const struct TilepressHost* host);

#ifdef __cplusplus
}
#endif
