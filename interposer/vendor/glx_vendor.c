// GLX vendor: as the EGL vendor, for libglvnd's libGLX.
#include <GL/glx.h>
#include <dlfcn.h>
#include <glvnd/libglxabi.h>
#include <stdio.h>
#include <stdlib.h>

#include "../preload/entry_points.h"
#include "../preload/gl_hooks.h"
#include "../preload/presenting.h"
#include "../preload/real_dlsym.h"

static void* (*driver_get_proc_address)(const GLubyte* name);

static void* get_proc_address(const GLubyte* name) {
  void* real = driver_get_proc_address(name);
  const int entry = real != NULL ? tp_find_entry((const char*)name) : -1;
  const int gl = real != NULL && entry < 0 ? tp_find_gl((const char*)name) : -1;
  if (gl >= 0) return tp_gl_answer(gl, real, false);
  const int looks_up = entry == TP_GLX_GET_PROC_ADDRESS || entry == TP_GLX_GET_PROC_ADDRESS_ARB;
  return entry >= 0 && !looks_up ? tp_bind((enum tp_entry)entry, real) : real;
}

static void* look_up(const char* name) {
  return driver_get_proc_address((const GLubyte*)name);
}

__attribute__((visibility("default"))) Bool __glx_Main(uint32_t version, const __GLXapiExports* exports,
                                                       __GLXvendorInfo* vendor, __GLXapiImports* imports) {
  char library[256];
  const char* driver_name = getenv("TILEPRESS_GLX_VENDOR");
  snprintf(library, sizeof library, "libGLX_%s.so.0",
           driver_name != NULL && *driver_name != 0 ? driver_name : "mesa");
  void* driver = dlopen(library, RTLD_LAZY);
  if (driver == NULL || tp_real_dlsym() == NULL) return False;
  __PFNGLXMAINPROC driver_main = (__PFNGLXMAINPROC)tp_real_dlsym()(driver, __GLX_MAIN_PROTO_NAME);
  if (driver_main == NULL || !driver_main(version, exports, vendor, imports)) return False;
  driver_get_proc_address = imports->getProcAddress;
  tp_driver_lookup[TILEPRESS_GLX] = look_up;
  imports->getProcAddress = get_proc_address;
  return True;
}

const char* const tp_via = "glvnd";
