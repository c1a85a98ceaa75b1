/* Refusing vendor: an EGL vendor library for libglvnd that has no display for anyone. */
#include <EGL/egl.h>
#include <glvnd/libeglabi.h>
#include <stddef.h>

static EGLDisplay get_display(EGLenum platform, void* native, const EGLAttrib* attributes) {
  (void)platform, (void)native, (void)attributes;
  return EGL_NO_DISPLAY;
}
static EGLBoolean supports_api(EGLenum api) {
  return api == EGL_OPENGL_ES_API;
}
static const char* vendor_string(int name) {
  (void)name;
  return NULL;
}
static void* nothing(const char* name) {
  (void)name;
  return NULL;
}
static void set_index(const char* name, int index) {
  (void)name, (void)index;
}

__attribute__((visibility("default"))) EGLBoolean __egl_Main(uint32_t version, const __EGLapiExports* exports,
                                                             __EGLvendorInfo* vendor,
                                                             __EGLapiImports* imports) {
  (void)version, (void)exports, (void)vendor;
  imports->getPlatformDisplay = get_display;
  imports->getSupportsAPI = supports_api;
  imports->getVendorString = vendor_string;
  imports->getProcAddress = nothing;
  imports->getDispatchAddress = nothing;
  imports->setDispatchIndex = set_index;
  return EGL_TRUE;
}
