// Hooks: each calls the engine, then the real function, then the engine, and returns the real function's
// value. After the real call a hook calls neither GL nor EGL: the program must read the error of its own
// call.
#include "hooks.h"

#include <stddef.h>

#include "current_drawables.h"
#include "elf_symbols.h"
#include "gl_calls.h"
#include "gl_hooks.h"
#include "presenting.h"

static struct TilepressPresent egl_present(void* real, tp_display display, tp_egl_surface surface) {
  return (struct TilepressPresent){
      .api = TILEPRESS_EGL, .real = real, .display = display, .surface = (uintptr_t)surface};
}

tp_egl_boolean tp_on_egl_swap(void* real, tp_display display, tp_egl_surface surface) {
  struct TilepressPresent present = egl_present(real, display, surface);
  const bool taken = tp_presenting(&present);
  const tp_egl_boolean result = ((tp_egl_boolean(*)(tp_display, tp_egl_surface))real)(display, surface);
  if (taken) tp_presented(&present, result != 0);
  return result;
}

tp_egl_boolean tp_on_egl_swap_with_damage(void* real, tp_display display, tp_egl_surface surface,
                                          const tp_egl_int* rectangles, tp_egl_int count) {
  typedef tp_egl_boolean (*function)(tp_display, tp_egl_surface, const tp_egl_int*, tp_egl_int);
  struct TilepressPresent present = egl_present(real, display, surface);
  present.damage = rectangles;
  present.damage_count = count;
  const bool taken = tp_presenting(&present);
  const tp_egl_boolean result = ((function)real)(display, surface, rectangles, count);
  if (taken) tp_presented(&present, result != 0);
  return result;
}

tp_egl_boolean tp_on_egl_post_sub_buffer(void* real, tp_display display, tp_egl_surface surface, tp_egl_int x,
                                         tp_egl_int y, tp_egl_int width, tp_egl_int height) {
  typedef tp_egl_boolean (*function)(tp_display, tp_egl_surface, tp_egl_int, tp_egl_int, tp_egl_int,
                                     tp_egl_int);
  const int32_t damage[4] = {x, y, width, height};
  struct TilepressPresent present = egl_present(real, display, surface);
  present.damage = damage;
  present.damage_count = 1;
  const bool taken = tp_presenting(&present);
  const tp_egl_boolean result = ((function)real)(display, surface, x, y, width, height);
  if (taken) tp_presented(&present, result != 0);
  return result;
}

static struct TilepressPresent glx_present(void* real, tp_display display, tp_glx_drawable drawable) {
  return (struct TilepressPresent){.api = TILEPRESS_GLX,
                                   .real = real,
                                   .display = display,
                                   .surface = drawable,
                                   .current_elsewhere = tp_is_current_elsewhere(drawable),
                                   .context_destroyed = tp_current_context_is_destroyed()};
}

void tp_on_glx_swap(void* real, tp_display display, tp_glx_drawable drawable) {
  struct TilepressPresent present = glx_present(real, display, drawable);
  const bool taken = tp_presenting(&present);
  ((void (*)(tp_display, tp_glx_drawable))real)(display, drawable);
  if (taken) tp_presented(&present, true);
}

int64_t tp_on_glx_swap_msc(void* real, tp_display display, tp_glx_drawable drawable, int64_t target_msc,
                           int64_t divisor, int64_t remainder) {
  typedef int64_t (*function)(tp_display, tp_glx_drawable, int64_t, int64_t, int64_t);
  struct TilepressPresent present = glx_present(real, display, drawable);
  const bool taken = tp_presenting(&present);
  const int64_t result = ((function)real)(display, drawable, target_msc, divisor, remainder);
  if (taken) tp_presented(&present, result >= 0);
  return result;
}

void tp_on_glx_copy_sub_buffer(void* real, tp_display display, tp_glx_drawable drawable, int x, int y,
                               int width, int height) {
  const int32_t damage[4] = {x, y, width, height};
  struct TilepressPresent present = glx_present(real, display, drawable);
  present.damage = damage;
  present.damage_count = 1;
  const bool taken = tp_presenting(&present);
  ((void (*)(tp_display, tp_glx_drawable, int, int, int, int))real)(display, drawable, x, y, width, height);
  if (taken) tp_presented(&present, true);
}

int tp_on_glx_make_current(void* real, tp_display display, tp_glx_drawable drawable, tp_context context) {
  const uintptr_t arguments[] = {(uintptr_t)display, drawable, (uintptr_t)context};
  tp_gl_making_current(TILEPRESS_GL_MAKE_CURRENT_3, arguments);
  const int result = ((int (*)(tp_display, tp_glx_drawable, tp_context))real)(display, drawable, context);
  if (result != 0) tp_made_current(drawable, drawable, (uintptr_t)context);
  return result;
}

int tp_on_glx_make_context_current(void* real, tp_display display, tp_glx_drawable draw, tp_glx_drawable read,
                                   tp_context context) {
  typedef int (*function)(tp_display, tp_glx_drawable, tp_glx_drawable, tp_context);
  const uintptr_t arguments[] = {(uintptr_t)display, draw, read, (uintptr_t)context};
  tp_gl_making_current(TILEPRESS_GL_MAKE_CURRENT, arguments);
  const int result = ((function)real)(display, draw, read, context);
  if (result != 0) tp_made_current(draw, read, (uintptr_t)context);
  return result;
}

// OSMesa has no presenting call: glFinish, glFlush or glfwSwapBuffers ends a frame.

unsigned char tp_on_osmesa_make_current(void* real, tp_context context, void* buffer, unsigned type,
                                        int width, int height, void* caller) {
  typedef unsigned char (*function)(tp_context, void*, unsigned, int, int);
  const unsigned char result = ((function)real)(context, buffer, type, width, height);
  const bool current = result != 0 && context != NULL;
  tp_gl_osmesa_current(current ? real : NULL,
                       current && tp_symbol_in_object_of(caller, "glfwSwapBuffers") != NULL);
  return result;
}

void* tp_on_osmesa_get_proc_address(void* real, const char* name) {
  void* answer = ((void* (*)(const char*))real)(name);
  const int gl = tp_find_gl(name);
  if (answer != NULL && gl >= 0 && tp_is_ours(answer)) answer = tp_symbol_in_object_of(real, name);
  return gl >= 0 ? tp_gl_answer(gl, answer, true) : answer;
}

void tp_on_osmesa_destroy_context(void* real, tp_context context) {
  tp_contexts_going(TILEPRESS_OSMESA, NULL, context);
  ((void (*)(tp_context))real)(context);
}

// Where GLFW uses EGL or GLX, its call ends in theirs, and the thread has no OSMesa context.
void tp_on_glfw_swap(void* real, void* window) {
  struct TilepressPresent present = {.api = TILEPRESS_OSMESA, .real = tp_gl_osmesa()};
  const bool taken = tp_presenting(&present);
  ((void (*)(void*))real)(window);
  if (taken) tp_presented(&present, true);
}

// The engine lets go of what it keeps before the real call, while the handles are still valid.

tp_egl_boolean tp_on_egl_destroy_context(void* real, tp_display display, tp_context context) {
  tp_contexts_going(TILEPRESS_EGL, display, context);
  return ((tp_egl_boolean(*)(tp_display, tp_context))real)(display, context);
}

tp_egl_boolean tp_on_egl_destroy_surface(void* real, tp_display display, tp_egl_surface surface) {
  tp_surface_going(display, (uintptr_t)surface);
  return ((tp_egl_boolean(*)(tp_display, tp_egl_surface))real)(display, surface);
}

tp_egl_boolean tp_on_egl_terminate(void* real, tp_display display) {
  tp_contexts_going(TILEPRESS_EGL, display, NULL);
  return ((tp_egl_boolean(*)(tp_display))real)(display);
}

void tp_on_glx_destroy_context(void* real, tp_display display, tp_context context) {
  tp_contexts_going(TILEPRESS_GLX, display, context);
  tp_context_destroyed((uintptr_t)context);
  ((void (*)(tp_display, tp_context))real)(display, context);
}
