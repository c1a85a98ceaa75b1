/* tilepress-self-test: presents three frames of one colour each from a pbuffer, reaching libEGL as most
   programs on Debian do. Started by `tilepress doctor` under the shim. */
#define _GNU_SOURCE
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <dlfcn.h>
#include <stddef.h>

static void* egl;

#define FIND(name) __typeof__(&name) find_##name = (__typeof__(&name))dlsym(egl, #name)

int main(void) {
  egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (egl == NULL) return 1;
  FIND(eglGetProcAddress);
  FIND(eglInitialize);
  FIND(eglChooseConfig);
  FIND(eglBindAPI);
  FIND(eglCreateContext);
  FIND(eglCreatePbufferSurface);
  FIND(eglMakeCurrent);
  FIND(eglSwapBuffers);
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
      (PFNEGLGETPLATFORMDISPLAYEXTPROC)find_eglGetProcAddress("eglGetPlatformDisplayEXT");
  if (get_display == NULL) return 1;
  EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
  if (!find_eglInitialize(display, NULL, NULL)) return 1;
  const EGLint wishes[] = {EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_ES2_BIT,
                           EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           8,
                           EGL_NONE};
  const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  EGLConfig config = NULL;
  EGLint count = 0;
  if (!find_eglChooseConfig(display, wishes, &config, 1, &count) || count == 0) return 1;
  find_eglBindAPI(EGL_OPENGL_ES_API);
  EGLContext context = find_eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  EGLSurface surface = find_eglCreatePbufferSurface(display, config, size);
  if (!find_eglMakeCurrent(display, surface, surface, context)) return 1;
  __typeof__(&glClearColor) clear_color = (__typeof__(&glClearColor))find_eglGetProcAddress("glClearColor");
  __typeof__(&glClear) clear = (__typeof__(&glClear))find_eglGetProcAddress("glClear");
  for (int frame = 0; frame < 3; ++frame) {
    clear_color((float)frame / 3, 0.5f, 0.25f, 1);
    clear(GL_COLOR_BUFFER_BIT);
    if (!find_eglSwapBuffers(display, surface)) return 1;
  }
  return 0;
}
