// Engine contract: the calls and data that the preloaded library and its engine share. C, no dependency.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TILEPRESS_ENGINE_VERSION = 9 };

enum TilepressApi { TILEPRESS_EGL, TILEPRESS_GLX, TILEPRESS_OSMESA, TILEPRESS_API_COUNT };

// How a call reached the hooks: through the preloaded library, or through a vendor library of libglvnd.
enum TilepressRoad { TILEPRESS_ROAD_PRELOAD, TILEPRESS_ROAD_GLVND, TILEPRESS_ROAD_COUNT };

// What `begin` notes for `end`. Only the engine reads it. The hook passes zeros to `begin`.
struct TilepressTicket {
  uint32_t outcome;   // what became of the frame; 0 = the engine does not count the call
  uint32_t window;    // number of the window, or ~0
  void* frame;        // the pixels; NULL unless the frame was taken
  uint64_t begin_ns;  // when the call came in
  uint64_t hook_ns;   // how long `begin` took
};

// A presenting call, before it is forwarded. The hook fills everything but the ticket.
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
  uint32_t road;                       // enum TilepressRoad
  void* (*look_up)(const char* name);  // the driver's functions where no public library answers; NULL else
  struct TilepressTicket ticket;
};

// What a watched GL call means.
enum TilepressGlKind {
  TILEPRESS_GL_DRAW,  // sets the thread's mark and does not call the engine
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
  uint32_t by_default;         // a trigger without an option: the context is OSMesa's
  uint32_t context_destroyed;  // as in TilepressPresent
  void* osmesa;                // a function of OSMesa's library, if the thread has an OSMesa context
  uint32_t road;               // enum TilepressRoad
  // The first integer and pointer arguments, as registers hold them: upper halves are noise.
  const uintptr_t* arguments;
  void* (*look_up[TILEPRESS_API_COUNT])(const char* name);  // as in TilepressPresent
};

struct TilepressEngine {
  uint32_t version;
  // Captures the frame that `present` is about to present. Returns 0 if `end` must not be called. Leaves the
  // thread's context, its GL and EGL state and errno as they are. No failure reaches the program.
  int (*begin)(struct TilepressPresent* present);
  // The presenting call has returned; `presented` = it succeeded. Calls neither GL nor EGL.
  void (*end)(struct TilepressPresent* present, int presented);
  // The program is about to call a watched GL function. Leaves the thread as `begin` does.
  void (*gl_call)(const struct TilepressGlCall* call);
  // Where the calling thread marks that it has drawn.
  uint8_t* (*drawn_mark)(void);
  // The program is about to destroy `context` of `display`, or the whole display (NULL). The engine first
  // destroys its own contexts on that display.
  void (*contexts_going)(uint32_t api, void* display, void* context);
  // The program is about to destroy an EGL surface. A later surface may get the same handle.
  void (*surface_going)(void* display, uintptr_t surface);
  // The process is about to end. Writes out every frame taken. May be called more than once.
  void (*finish)(void);
};

// What the engine may use of the library that loads it.
struct TilepressHost {
  uint32_t version;
  void* (*dlsym)(void* handle, const char* name);  // the real one
  // Copies the path of the library that holds `address`. Returns false for the program itself, and if `size`
  // is too small.
  bool (*path_of_object)(const void* address, char* path, size_t size);
};

// The only symbol that the engine exports. Returns NULL if the versions differ.
typedef const struct TilepressEngine* (*TilepressEngineEntry)(const struct TilepressHost* host);
const struct TilepressEngine* tilepress_engine(const struct TilepressHost* host);

#ifdef __cplusplus
}
#endif
