// Entry points: the names the shim answers for, and the hook instances that are bound to real functions.
#pragma once

#include <stdbool.h>

// In the order of their names: the filter searches this table by bisection.
enum tp_entry {
  TP_OSMESA_DESTROY_CONTEXT,
  TP_OSMESA_GET_PROC_ADDRESS,
  TP_OSMESA_MAKE_CURRENT,
  TP_EGL_DESTROY_CONTEXT,
  TP_EGL_DESTROY_SURFACE,
  TP_EGL_GET_PROC_ADDRESS,
  TP_EGL_POST_SUB_BUFFER_NV,
  TP_EGL_SWAP_BUFFERS,
  TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_EXT,
  TP_EGL_SWAP_BUFFERS_WITH_DAMAGE_KHR,
  TP_EGL_TERMINATE,
  TP_GLX_COPY_SUB_BUFFER_MESA,
  TP_GLX_DESTROY_CONTEXT,
  TP_GLX_GET_PROC_ADDRESS,
  TP_GLX_GET_PROC_ADDRESS_ARB,
  TP_GLX_MAKE_CONTEXT_CURRENT,
  TP_GLX_MAKE_CURRENT,
  TP_GLX_SWAP_BUFFERS,
  TP_GLX_SWAP_BUFFERS_MSC_OML,
  TP_GLFW_SWAP_BUFFERS,
  TP_ENTRY_COUNT
};

// A process may hold several libraries that define one entry point (Chromium: ANGLE and the system's libEGL):
// a hook is bound to a real function, not to a name, and each entry point has this many hooks.
enum { TP_BANK_SIZE = 8 };

enum { TP_ENTRY_NAME_SIZE = 28 };  // of the longest, with its zero

extern const char tp_entry_names[TP_ENTRY_COUNT][TP_ENTRY_NAME_SIZE];
extern void* tp_bound[TP_ENTRY_COUNT][TP_BANK_SIZE];
extern void* const tp_hooks[TP_ENTRY_COUNT][TP_BANK_SIZE];

// The entry point called `name`, or -1.
int tp_find_entry(const char* name);

// A hook that forwards to `real`. When all hooks of the entry are bound elsewhere: `real` itself, which is
// then not seen by the shim.
void* tp_bind(enum tp_entry entry, void* real);

// The function that a call of our exported `entry` from the code at `caller` would have reached without the
// shim; NULL when no library defines it.
void* tp_next_definition(enum tp_entry entry, void* caller);

// The same for a name that is no entry point. Looks it up each time.
void* tp_definition_after_ours(const char* name, void* caller);

// `function` may be called at any later time, also after the program has closed the library that its pointer
// came from: the library stays.
void tp_pin_library_of(void* function);

// What a GetProcAddress function must answer for `name` when the real one, `get_proc_address`, said `real`.
void* tp_answer_get_proc_address(const char* name, void* real, void* get_proc_address);
