/* Strict vendor: Mesa as a GLX vendor library for libglvnd that ends the program where NVIDIA's has the X
   server raise an error: when it is asked about a context that is destroyed, though still current. */
#include <GL/glx.h>
#include <dlfcn.h>
#include <glvnd/libglxabi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void* (*mesa)(const GLubyte* name);
static GLXContext destroyed;

static void destroy_context(Display* display, GLXContext context) {
  destroyed = context;
  ((void (*)(Display*, GLXContext))mesa((const GLubyte*)"glXDestroyContext"))(display, context);
}

static int query_context(Display* display, GLXContext context, int attribute, int* value) {
  if (context == destroyed) {
    fprintf(stderr, "GLXBadContext\n");
    exit(1);
  }
  return ((PFNGLXQUERYCONTEXTPROC)mesa((const GLubyte*)"glXQueryContext"))(display, context, attribute,
                                                                           value);
}

/* NVIDIA's answers with the number that the context had. */
static GLXContextID context_id(const GLXContext context) {
  (void)context;
  return 1;
}

static void* get_proc_address(const GLubyte* name) {
  if (strcmp((const char*)name, "glXDestroyContext") == 0) return (void*)destroy_context;
  if (strcmp((const char*)name, "glXQueryContext") == 0) return (void*)query_context;
  if (strcmp((const char*)name, "glXGetContextIDEXT") == 0) return (void*)context_id;
  return mesa(name);
}

__attribute__((visibility("default"))) Bool __glx_Main(uint32_t version, const __GLXapiExports* exports,
                                                       __GLXvendorInfo* vendor, __GLXapiImports* imports) {
  void* library = dlopen("libGLX_mesa.so.0", RTLD_LAZY);
  __PFNGLXMAINPROC real = library != NULL ? (__PFNGLXMAINPROC)dlsym(library, "__glx_Main") : NULL;
  if (real == NULL || !real(version, exports, vendor, imports)) return False;
  mesa = imports->getProcAddress;
  imports->getProcAddress = get_proc_address;
  return True;
}
