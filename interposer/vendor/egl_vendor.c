// EGL vendor: libglvnd's libEGL loads this library in place of the driver's. It loads the driver, and puts
// hooks in front of the driver's presenting calls. This also reaches plugins opened with RTLD_DEEPBIND.
#include <EGL/egl.h>
#include <dlfcn.h>
#include <glvnd/libeglabi.h>
#include <stddef.h>

#include "../preload/c_library.h"
#include "../preload/environment.h"
#include "../preload/hook_bank.h"
#include "../preload/presenting.h"

// libglvnd loads a library only once. So each of its vendor files names a copy of this library, and each copy
// has a variable with its driver. The first copy falls back to Mesa.
#ifndef TP_DRIVER_VARIABLE
#define TP_DRIVER_VARIABLE "TILEPRESS_EGL_VENDOR"
#define TP_DRIVER_ELSE "libEGL_mesa.so.0"
#else
#define TP_DRIVER_ELSE NULL
#endif

static void* (*driver_get_proc_address)(const char* name);

static void* get_proc_address(const char* name) {
  return tp_answer_vendor(name, driver_get_proc_address(name));
}

__attribute__((visibility("default"))) EGLBoolean __egl_Main(uint32_t version, const __EGLapiExports* exports,
                                                             __EGLvendorInfo* vendor,
                                                             __EGLapiImports* imports) {
  const struct tp_c_library* library = tp_c_library();
  const char* driver_name = tp_environment(TP_DRIVER_VARIABLE);
  if (driver_name == NULL) driver_name = TP_DRIVER_ELSE;
  void* driver = library != NULL && driver_name != NULL ? library->dlopen(driver_name, RTLD_LAZY) : NULL;
  if (driver == NULL) return EGL_FALSE;
  __PFNEGLMAINPROC driver_main = (__PFNEGLMAINPROC)library->dlsym(driver, __EGL_MAIN_PROTO_NAME);
  if (driver_main == NULL || !driver_main(version, exports, vendor, imports)) return EGL_FALSE;
  driver_get_proc_address = imports->getProcAddress;
  tp_come_through_glvnd(TILEPRESS_EGL, imports->getProcAddress);
  imports->getProcAddress = get_proc_address;
  return EGL_TRUE;
}
