// Hooks: each forwards to the real function `real`.
#pragma once

#include <stdint.h>

typedef void* tp_display;               // EGLDisplay, Display*
typedef void* tp_context;               // EGLContext, GLXContext
typedef void* tp_egl_surface;           // EGLSurface
typedef unsigned long tp_glx_drawable;  // GLXDrawable, an XID
typedef unsigned tp_egl_boolean;        // EGLBoolean
typedef int32_t tp_egl_int;             // EGLint

tp_egl_boolean tp_on_egl_swap(void* real, tp_display display, tp_egl_surface surface);
tp_egl_boolean tp_on_egl_swap_with_damage(void* real, tp_display display, tp_egl_surface surface,
                                          const tp_egl_int* rectangles, tp_egl_int count);
tp_egl_boolean tp_on_egl_post_sub_buffer(void* real, tp_display display, tp_egl_surface surface, tp_egl_int x,
                                         tp_egl_int y, tp_egl_int width, tp_egl_int height);
tp_egl_boolean tp_on_egl_destroy_context(void* real, tp_display display, tp_context context);
tp_egl_boolean tp_on_egl_destroy_surface(void* real, tp_display display, tp_egl_surface surface);
tp_egl_boolean tp_on_egl_terminate(void* real, tp_display display);
void tp_on_glx_destroy_context(void* real, tp_display display, tp_context context);
int tp_on_glx_make_current(void* real, tp_display display, tp_glx_drawable drawable, tp_context context);
int tp_on_glx_make_context_current(void* real, tp_display display, tp_glx_drawable draw, tp_glx_drawable read,
                                   tp_context context);
void tp_on_osmesa_destroy_context(void* real, tp_context context);
void* tp_on_osmesa_get_proc_address(void* real, const char* name);
// `caller`: an address in the calling code.
unsigned char tp_on_osmesa_make_current(void* real, tp_context context, void* buffer, unsigned type,
                                        int width, int height, void* caller);
void tp_on_glfw_swap(void* real, void* window);
void tp_on_glx_swap(void* real, tp_display display, tp_glx_drawable drawable);
int64_t tp_on_glx_swap_msc(void* real, tp_display display, tp_glx_drawable drawable, int64_t target_msc,
                           int64_t divisor, int64_t remainder);
void tp_on_glx_copy_sub_buffer(void* real, tp_display display, tp_glx_drawable drawable, int x, int y,
                               int width, int height);
