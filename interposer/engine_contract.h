// Engine contract: what the preloaded library and the engine it loads know of each other. C, no dependency.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TILEPRESS_ENGINE_VERSION = 8 };

enum TilepressApi { TILEPRESS_EGL, TILEPRESS_GLX, TILEPRESS_OSMESA, TILEPRESS_API_COUNT };

// A presenting call, before it is forwarded. The first part is filled by the hook.
struct TilepressPresent {
  uint32_t api;                // enum TilepressApi
  void* real;                  // the function the call is forwarded to
  void* display;               // EGLDisplay or Display*; NULL for OSMesa
  uintptr_t surface;           // EGLSurface or GLXDrawable; 0 for OSMesa
  uint32_t current_elsewhere;  // GLX: another thread has the drawable current
  uint32_t context_destroyed;  // GLX: the context that the calling thread has current is destroyed
  // x, y, width, height of each damage rectangle, origin at the bottom left; NULL = the whole surface
  const int32_t* damage;
  int32_t damage_count;
  const char* via;                     // road of the call, as in run.json
  void* (*look_up)(const char* name);  // the driver's functions where no public library answers; NULL else
  void* ticket[6];                     // the engine's own, from begin to end
};

// What a watched GL call means. The first is a mark alone: no call of the engine.
enum TilepressGlKind {
  TILEPRESS_GL_DRAW,
  TILEPRESS_GL_CLEAR,
  TILEPRESS_GL_CLEAR_BUFFER,
  TILEPRESS_GL_BIND_FRAMEBUFFER,
  TILEPRESS_GL_DELETE_FRAMEBUFFERS,
  TILEPRESS_GL_DELETE_TEXTURES,
  TILEPRESS_GL_DELETE_RENDERBUFFERS,
  TILEPRESS_GL_DRAW_BUFFER,
  TILEPRESS_GL_DRAW_BUFFERS,
  TILEPRESS_GL_ATTACH,
  TILEPRESS_GL_INVALIDATE,
  TILEPRESS_GL_RESPECIFY,
  TILEPRESS_GL_MAKE_CURRENT,    // the context is the fourth argument
  TILEPRESS_GL_MAKE_CURRENT_3,  // the third
  TILEPRESS_GL_FINISH,
  TILEPRESS_GL_FLUSH,
  TILEPRESS_GL_READ_PIXELS,
  TILEPRESS_GL_KINDS
};

// A watched GL call, before it is forwarded.
struct TilepressGlCall {
  uint32_t kind;               // enum TilepressGlKind
  uint32_t by_default;         // a trigger that was not asked for: the context is OSMesa's
  uint32_t context_destroyed;  // as in TilepressPresent
  void* osmesa;                // a function of OSMesa's library, if one of its contexts was made current here
  const uintptr_t*
      arguments;    // the first integer and pointer arguments, in registers: upper halves are noise
  const char* via;  // as in TilepressPresent, as is look_up
  void* (*look_up[TILEPRESS_API_COUNT])(const char* name);
};

struct TilepressEngine {
  uint32_t version;
  // Takes the frame that `present` is about to present. Returns 0 if end must not be called. Leaves the
  // thread's context, its GL and EGL state and errno as they are. Never fails visibly.
  int (*begin)(struct TilepressPresent* present);
  // The presenting call has returned; `presented` = it succeeded. Calls neither GL nor EGL.
  void (*end)(struct TilepressPresent* present, int presented);
  // The program is about to call a watched GL function. Leaves everything as begin does.
  void (*gl_call)(const struct TilepressGlCall* call);
  // Where the calling thread marks that it has drawn.
  uint8_t* (*drawn_mark)(void);
  // The program is about to destroy `context` of `display`, or all of them (NULL): ours on it go first.
  void (*contexts_going)(uint32_t api, void* display, void* context);
  // The program is about to destroy an EGL surface: one that is made later with the same handle is another.
  void (*surface_going)(void* display, uintptr_t surface);
  // The process is about to end: every frame taken is written out. May be called more than once.
  void (*finish)(void);
};

// What the engine may use of the library that loads it.
struct TilepressHost {
  uint32_t version;
  void* (*dlsym)(void* handle, const char* name);  // the real one
  // Copies the path of the library that holds `address`. False if it is the program itself or does not fit.
  bool (*path_of_object)(const void* address, char* path, size_t size);
};

// The one symbol the engine exports. NULL if the versions do not fit.
typedef const struct TilepressEngine* (*TilepressEngineEntry)(const struct TilepressHost* host);
const struct TilepressEngine* tilepress_engine(const struct TilepressHost* host);

#ifdef __cplusplus
}
#endif
