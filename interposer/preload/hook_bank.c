// Hook bank: for every entry point, TP_BANK_SIZE functions that each know the real function they are bound
// to, and the exported function that link-time callers reach.
#include <stddef.h>

#include "entry_points.h"
#include "hooks.h"
#include "session_file.h"

#define EXPORT __attribute__((visibility("default")))

static void* bound(enum tp_entry entry, int slot) {
  return __atomic_load_n(&tp_bound[entry][slot], __ATOMIC_ACQUIRE);
}

static void* linked(enum tp_entry entry, void* caller) {
  tp_session_note(tp_entry_names[entry], "link");
  return tp_next_definition(entry, caller);
}

#define INSTANCE(result, name, entry, slot, hook, parameters, ...) \
  static result name##_##slot parameters {                         \
    return hook(bound(entry, slot), __VA_ARGS__);                  \
  }

#define ENTRY_POINT(result, name, entry, hook, parameters, ...)           \
  EXPORT result name parameters;                                          \
  EXPORT result name parameters {                                         \
    return hook(linked(entry, __builtin_return_address(0)), __VA_ARGS__); \
  }                                                                       \
  INSTANCE(result, name, entry, 0, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 1, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 2, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 3, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 4, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 5, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 6, hook, parameters, __VA_ARGS__)         \
  INSTANCE(result, name, entry, 7, hook, parameters, __VA_ARGS__)

#define BANK(name) \
  { name##_0, name##_1, name##_2, name##_3, name##_4, name##_5, name##_6, name##_7 }

#define DISPLAY (tp_display display)
#define CONTEXT (tp_display display, tp_context context)
#define SURFACE (tp_display display, tp_egl_surface surface)
#define SURFACE_DAMAGE \
  (tp_display display, tp_egl_surface surface, const tp_egl_int* rectangles, tp_egl_int count)
#define SURFACE_BOX                                                                          \
  (tp_display display, tp_egl_surface surface, tp_egl_int x, tp_egl_int y, tp_egl_int width, \
   tp_egl_int height)
#define OSMESA_BUFFER (tp_context context, void* buffer, unsigned type, int width, int height)
#define DRAWABLE (tp_display display, tp_glx_drawable drawable)
#define DRAWABLE_CONTEXT (tp_display display, tp_glx_drawable drawable, tp_context context)
#define DRAWABLES_CONTEXT (tp_display display, tp_glx_drawable draw, tp_glx_drawable read, tp_context context)
#define DRAWABLE_MSC \
  (tp_display display, tp_glx_drawable drawable, int64_t target_msc, int64_t divisor, int64_t remainder)
#define DRAWABLE_BOX (tp_display display, tp_glx_drawable drawable, int x, int y, int width, int height)

ENTRY_POINT(void*, eglGetProcAddress, TP_EGL_GET_PROC_ADDRESS, tp_on_get_proc_address, (const char* name),
            name)
ENTRY_POINT(void*, glXGetProcAddress, TP_GLX_GET_PROC_ADDRESS, tp_on_get_proc_address, (const char* name),
            name)
ENTRY_POINT(void*, glXGetProcAddressARB, TP_GLX_GET_PROC_ADDRESS_ARB, tp_on_get_proc_address,
            (const char* name), name)
ENTRY_POINT(tp_egl_boolean, eglDestroyContext, TP_EGL_DESTROY_CONTEXT, tp_on_egl_destroy_context, CONTEXT,
            display, context)
ENTRY_POINT(tp_egl_boolean, eglDestroySurface, TP_EGL_DESTROY_SURFACE, tp_on_egl_destroy_surface, SURFACE,
            display, surface)
ENTRY_POINT(tp_egl_boolean, eglTerminate, TP_EGL_TERMINATE, tp_on_egl_terminate, DISPLAY, display)
ENTRY_POINT(void, glXDestroyContext, TP_GLX_DESTROY_CONTEXT, tp_on_glx_destroy_context, CONTEXT, display,
            context)
ENTRY_POINT(tp_egl_boolean, eglSwapBuffers, TP_EGL_SWAP_BUFFERS, tp_on_egl_swap, SURFACE, display, surface)
ENTRY_POINT(tp_egl_boolean, eglSwapBuffersWithDamageEXT, TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_EXT,
            tp_on_egl_swap_with_damage, SURFACE_DAMAGE, display, surface, rectangles, count)
ENTRY_POINT(tp_egl_boolean, eglSwapBuffersWithDamageKHR, TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_KHR,
            tp_on_egl_swap_with_damage, SURFACE_DAMAGE, display, surface, rectangles, count)
ENTRY_POINT(tp_egl_boolean, eglPostSubBufferNV, TP_EGL_POST_SUB_BUFFER_NV, tp_on_egl_post_sub_buffer,
            SURFACE_BOX, display, surface, x, y, width, height)
ENTRY_POINT(int, glXMakeCurrent, TP_GLX_MAKE_CURRENT, tp_on_glx_make_current, DRAWABLE_CONTEXT, display,
            drawable, context)
ENTRY_POINT(int, glXMakeContextCurrent, TP_GLX_MAKE_CONTEXT_CURRENT, tp_on_glx_make_context_current,
            DRAWABLES_CONTEXT, display, draw, read, context)
ENTRY_POINT(void, glXSwapBuffers, TP_GLX_SWAP_BUFFERS, tp_on_glx_swap, DRAWABLE, display, drawable)
ENTRY_POINT(int64_t, glXSwapBuffersMscOML, TP_GLX_SWAP_BUFFERS_MSC_OML, tp_on_glx_swap_msc, DRAWABLE_MSC,
            display, drawable, target_msc, divisor, remainder)
ENTRY_POINT(void, glXCopySubBufferMESA, TP_GLX_COPY_SUB_BUFFER_MESA, tp_on_glx_copy_sub_buffer, DRAWABLE_BOX,
            display, drawable, x, y, width, height)

ENTRY_POINT(void, OSMesaDestroyContext, TP_OSMESA_DESTROY_CONTEXT, tp_on_osmesa_destroy_context,
            (tp_context context), context)
ENTRY_POINT(void*, OSMesaGetProcAddress, TP_OSMESA_GET_PROC_ADDRESS, tp_on_osmesa_get_proc_address,
            (const char* name), name)
ENTRY_POINT(unsigned char, OSMesaMakeCurrent, TP_OSMESA_MAKE_CURRENT, tp_on_osmesa_make_current,
            OSMESA_BUFFER, context, buffer, type, width, height, __builtin_return_address(0))
ENTRY_POINT(void, glfwSwapBuffers, TP_GLFW_SWAP_BUFFERS, tp_on_glfw_swap, (void* window), window)

void* const tp_hooks[TP_ENTRY_COUNT][TP_BANK_SIZE] = {
    [TP_EGL_DESTROY_CONTEXT] = BANK(eglDestroyContext),
    [TP_EGL_DESTROY_SURFACE] = BANK(eglDestroySurface),
    [TP_EGL_TERMINATE] = BANK(eglTerminate),
    [TP_GLX_DESTROY_CONTEXT] = BANK(glXDestroyContext),
    [TP_EGL_GET_PROC_ADDRESS] = BANK(eglGetProcAddress),
    [TP_EGL_POST_SUB_BUFFER_NV] = BANK(eglPostSubBufferNV),
    [TP_EGL_SWAP_BUFFERS] = BANK(eglSwapBuffers),
    [TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_EXT] = BANK(eglSwapBuffersWithDamageEXT),
    [TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_KHR] = BANK(eglSwapBuffersWithDamageKHR),
    [TP_GLX_COPY_SUB_BUFFER_MESA] = BANK(glXCopySubBufferMESA),
    [TP_GLX_GET_PROC_ADDRESS] = BANK(glXGetProcAddress),
    [TP_GLX_GET_PROC_ADDRESS_ARB] = BANK(glXGetProcAddressARB),
    [TP_GLX_MAKE_CONTEXT_CURRENT] = BANK(glXMakeContextCurrent),
    [TP_GLX_MAKE_CURRENT] = BANK(glXMakeCurrent),
    [TP_GLX_SWAP_BUFFERS] = BANK(glXSwapBuffers),
    [TP_GLX_SWAP_BUFFERS_MSC_OML] = BANK(glXSwapBuffersMscOML),
    [TP_OSMESA_DESTROY_CONTEXT] = BANK(OSMesaDestroyContext),
    [TP_OSMESA_GET_PROC_ADDRESS] = BANK(OSMesaGetProcAddress),
    [TP_OSMESA_MAKE_CURRENT] = BANK(OSMesaMakeCurrent),
    [TP_GLFW_SWAP_BUFFERS] = BANK(glfwSwapBuffers),
};
