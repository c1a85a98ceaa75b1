// GLX vendor: like the EGL vendor, for libglvnd's libGLX.
#include <GL/glx.h>
#include <dlfcn.h>
#include <glvnd/libglxabi.h>
#include <stddef.h>

#include "../preload/c_library.h"
#include "../preload/environment.h"
#include "../preload/hook_bank.h"
#include "../preload/plain_text.h"
#include "../preload/presenting.h"

static void* (*driver_get_proc_address)(const GLubyte* name);

static void* get_proc_address(const GLubyte* name) {
  return tp_answer_vendor((const char*)name, driver_get_proc_address(name));
}

static void* look_up(const char* name) {
  return driver_get_proc_address((const GLubyte*)name);
}

__attribute__((visibility("default"))) Bool __glx_Main(uint32_t version, const __GLXapiExports* exports,
                                                       __GLXvendorInfo* vendor_info,
                                                       __GLXapiImports* imports) {
  const struct tp_c_library* library = tp_c_library();
  const char* vendor = tp_environment("TILEPRESS_GLX_VENDOR");
  char bytes[256];
  struct tp_text name = {bytes, sizeof bytes, 0, false};
  tp_append(&name, "libGLX_");
  tp_append(&name, vendor != NULL ? vendor : "mesa");
  tp_append(&name, ".so.0");
  void* driver = library != NULL && !name.cut ? library->dlopen(bytes, RTLD_LAZY) : NULL;
  if (driver == NULL) return False;
  __PFNGLXMAINPROC driver_main = (__PFNGLXMAINPROC)library->dlsym(driver, __GLX_MAIN_PROTO_NAME);
  if (driver_main == NULL || !driver_main(version, exports, vendor_info, imports)) return False;
  driver_get_proc_address = imports->getProcAddress;
  tp_come_through_glvnd(TILEPRESS_GLX, look_up);
  imports->getProcAddress = get_proc_address;
  return True;
}
