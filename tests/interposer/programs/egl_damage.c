/* egl_damage: an X window presented with damage rectangles, by functions that only eglGetProcAddress gives;
   one more presenting call that the driver refuses. Prints what the calls return. */
#define _GNU_SOURCE
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <stdio.h>

#include "draw_known_picture.h"

int main(void) {
  Display* x = XOpenDisplay(NULL);
  if (x == NULL) return 9;
  EGLDisplay display = eglGetDisplay((EGLNativeDisplayType)x);
  eglInitialize(display, NULL, NULL);
  const EGLint wanted[] = {EGL_SURFACE_TYPE,    EGL_WINDOW_BIT,     EGL_RED_SIZE, 8,
                           EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_NONE};
  const EGLint wish[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  EGLConfig config = NULL;
  EGLint count = 0;
  eglChooseConfig(display, wanted, &config, 1, &count);
  const Window window = XCreateSimpleWindow(x, DefaultRootWindow(x), 0, 0, 64, 48, 0, 0, 0);
  XMapWindow(x, window);
  EGLSurface surface = eglCreateWindowSurface(display, config, window, NULL);
  if (!eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, NULL, wish))) return 9;
  PFNEGLSWAPBUFFERSWITHDAMAGEKHRPROC swap =
      (PFNEGLSWAPBUFFERSWITHDAMAGEKHRPROC)eglGetProcAddress("eglSwapBuffersWithDamageKHR");
  PFNEGLPOSTSUBBUFFERNVPROC post = (PFNEGLPOSTSUBBUFFERNVPROC)eglGetProcAddress("eglPostSubBufferNV");
  printf("dlsym gives %s\n",
         dlsym(RTLD_DEFAULT, "eglSwapBuffersWithDamageKHR") != NULL ? "something" : "nothing");
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  EGLint damage[] = {1, 2, 3, 4, 50, 6, 7, 8};
  for (unsigned frame = 0; frame < 3 && swap != NULL; ++frame) {
    draw_known_picture(&gl, frame, 64, 48);
    printf("swap %u\n", swap(display, surface, damage, (EGLint)frame));
  }
  if (post != NULL) printf("post %u 0x%x\n", post(display, surface, 1, 2, 3, 4), (unsigned)eglGetError());
  return 0;
}
