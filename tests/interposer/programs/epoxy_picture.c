/* epoxy_picture FRAMES WIDTH HEIGHT: presents the known picture from a pbuffer, every call through libepoxy.
 */
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <stdlib.h>

#include "draw_known_picture.h"

int main(int argc, char** argv) {
  if (argc < 4) return 9;
  const int frames = atoi(argv[1]), width = atoi(argv[2]), height = atoi(argv[3]);
  const EGLint wanted[] = {EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           8,
                           EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_ES2_BIT,
                           EGL_NONE};
  const EGLint wish[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
  EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLConfig config = NULL;
  EGLint count = 0;
  if (!eglInitialize(display, NULL, NULL)) {  // a driver other than Mesa's
    display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (!eglInitialize(display, NULL, NULL)) return 9;
  }
  if (!eglChooseConfig(display, wanted, &config, 1, &count)) return 9;
  EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  if (!eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, wish)))
    return 9;
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&gl, (unsigned)frame, width, height);
    eglSwapBuffers(display, surface);
  }
  return 0;
}
