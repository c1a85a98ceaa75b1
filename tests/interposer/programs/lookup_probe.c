/* lookup_probe: a program without GL that prints the results of lookups. The shim must not change the text. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>

int probe_number(void);

static void show(const char* what, void* handle, const char* name) {
  dlerror();
  const void* found = dlsym(handle, name);
  const char* error = dlerror();
  printf("%s %s: %s, %s\n", what, name, found != NULL ? "found" : "null",
         error != NULL ? "error" : "no error");
}

int main(void) {
  void* self = dlopen(NULL, RTLD_NOW);
  const char* names[] = {
#define TP_ENTRY(name, ...) #name,
#include "interposer/preload/entry_points.def"
#define TP_GL_TRIGGER(name, kind) #name,
#define TP_GL_TARGET(name, kind) #name,
#include "interposer/preload/gl_names.def"
      "no_such_function", "printf", "eglQueryString"};
  for (unsigned i = 0; i < sizeof names / sizeof *names; ++i) {
    show("default", RTLD_DEFAULT, names[i]);
    show("next", RTLD_NEXT, names[i]);
    show("self", self, names[i]);
  }
  void* egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  for (unsigned i = 0; i < sizeof names / sizeof *names; ++i) {
    show("egl", egl, names[i]);
    show("next with egl loaded", RTLD_NEXT, names[i]);
    show("default with egl loaded", RTLD_DEFAULT, names[i]);
  }
  dlsym(egl, "no_such_function");
  printf("%s\n", dlerror());
  printf("dlvsym %d\n", dlvsym(RTLD_DEFAULT, "printf", "NO_SUCH_VERSION") != NULL);
  printf("next of a library: %d\n", probe_number());
  return 5;
}
