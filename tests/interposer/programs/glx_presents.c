/* glx_presents MODE: presents the known picture in an X window, three frames of 64x48, and prints what the
   calls return. MODE: copy: by glXCopySubBufferMESA. msc: by glXSwapBuffersMscOML, which is asked for
   something impossible first each time. destroyed: from a context that has been destroyed while current.
   single: a single-buffered window. samples, srgb: a multisampled window, one whose values are encoded; the
   program draws a triangle instead and prints the pixels. */
#include <GL/glx.h>
#include <GL/glxext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "covering_triangle.h"
#include "draw_known_picture.h"

static void* find(const char* name) {
  return (void*)glXGetProcAddressARB((const GLubyte*)name);
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const char* mode = argv[1];
  Display* display = XOpenDisplay(NULL);
  if (display == NULL) return 9;
  const int buffering = strcmp(mode, "single") == 0 ? None : GLX_DOUBLEBUFFER;
  const int samples = strcmp(mode, "samples") == 0, srgb = strcmp(mode, "srgb") == 0;
  int wanted[14] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, buffering};
  if (samples) memcpy(wanted + 8, (int[]){GLX_SAMPLE_BUFFERS, 1, GLX_SAMPLES, 4}, 4 * sizeof(int));
  if (srgb) memcpy(wanted + 8, (int[]){GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB, True}, 2 * sizeof(int));
  XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), wanted);
  if (visual == NULL) return 77;
  const Window root = DefaultRootWindow(display);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
  const Window window = XCreateWindow(display, root, 0, 0, 64, 48, 0, visual->depth, InputOutput,
                                      visual->visual, CWColormap | CWBorderPixel, &attributes);
  XMapWindow(display, window);
  XSync(display, False);
  GLXContext context = glXCreateContext(display, visual, NULL, True);
  glXMakeCurrent(display, window, context);
  PFNGLXCOPYSUBBUFFERMESAPROC copy = (PFNGLXCOPYSUBBUFFERMESAPROC)find("glXCopySubBufferMESA");
  PFNGLXSWAPBUFFERSMSCOMLPROC swap_msc = (PFNGLXSWAPBUFFERSMSCOMLPROC)find("glXSwapBuffersMscOML");
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  if (srgb) glEnable(GL_FRAMEBUFFER_SRGB);
  for (int frame = 0; frame < 3; ++frame) {
    if (samples || srgb) {
      draw_covering_triangle((unsigned)frame);
      (samples ? print_resolved : print_pixels)(64, 48);
      glXSwapBuffers(display, window);
      continue;
    }
    draw_known_picture(&gl, (unsigned)frame, 64, 48);
    if (strcmp(mode, "copy") == 0) {
      copy(display, window, 8 * frame, 4, 16, 12);
    } else if (strcmp(mode, "msc") == 0) {
      printf("swap %s, ", swap_msc(display, window, 0, -1, 0) >= 0 ? "done" : "refused");
      printf("%s\n", swap_msc(display, window, 0, 0, 0) >= 0 ? "done" : "refused");
    } else {
      if (strcmp(mode, "destroyed") == 0 && frame == 0) glXDestroyContext(display, context);
      glXSwapBuffers(display, window);
    }
  }
  printf("error 0x%x, current %d\n", (unsigned)glGetError(), glXGetCurrentContext() == context);
  XCloseDisplay(display);
  return 0;
}
