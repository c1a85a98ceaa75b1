/* stub_egl: a libEGL that presents nothing, for machines where only the lookups can be tried. */
#include <string.h>

int eglSwapBuffers(void* display, void* surface);
const char* eglQueryString(void* display, int name);
void* eglGetProcAddress(const char* name);

int eglSwapBuffers(void* display, void* surface) {
  return display == surface;
}

const char* eglQueryString(void* display, int name) {
  (void)display, (void)name;
  return "stub";
}

void* eglGetProcAddress(const char* name) {
  return strcmp(name, "eglSwapBuffers") == 0 ? (void*)&eglSwapBuffers : NULL;
}
