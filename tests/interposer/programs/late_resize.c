/* late_resize egl|glx [finish]: an X window whose size changes when a frame has been drawn but not presented,
 * as when somebody pulls at its frame: 3 frames of each size. Prints what the window shows after each. Never
 * larger than before: Mesa's EGL shows memory beyond its buffer then. */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xutil.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_known_picture.h"

static Display* x;
static Window window;

static void make_window(XVisualInfo* visual, int width, int height) {
  const Window root = DefaultRootWindow(x);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(x, root, visual->visual, AllocNone)};
  window = XCreateWindow(x, root, 0, 0, (unsigned)width, (unsigned)height, 0, visual->depth, InputOutput,
                         visual->visual, CWColormap | CWBorderPixel | CWBackPixel, &attributes);
  XMapWindow(x, window);
  XSync(x, False);
}

static void print_shown(int frame, int width, int height) {
  XSync(x, False);
  XImage* image = XGetImage(x, window, 0, 0, (unsigned)width, (unsigned)height, AllPlanes, ZPixmap);
  if (image == NULL) exit(9);
  unsigned hash = 0;
  int black = 0;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const unsigned pixel = (unsigned)XGetPixel(image, column, row) & 0xFFFFFF;
      hash = hash * 33 + pixel;
      black += pixel == 0;
    }
  printf("frame %d, %dx%d: %08x, %d black\n", frame, width, height, hash, black);
  XDestroyImage(image);
}

int main(int argc, char** argv) {
  enum { kSizes = 4, kFramesOfEach = 3 };
  static const int kSize[kSizes][2] = {{60, 61}, {33, 48}, {32, 40}, {20, 17}};
  const bool glx = argc > 1 && strcmp(argv[1], "glx") == 0, finishes = argc > 2;
  x = XOpenDisplay(NULL);
  if (x == NULL) return 9;
  int width = 64, height = 70, count = 0;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  if (glx) {
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
    XVisualInfo* visual = glXChooseVisual(x, DefaultScreen(x), wanted);
    if (visual == NULL) return 9;
    make_window(visual, width, height);
    glXMakeCurrent(x, window, glXCreateContext(x, visual, NULL, True));
  } else {
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_ALPHA_SIZE,
                             0,
                             EGL_NONE};
    EGLConfig config = NULL;
    EGLint visual_id = 0;
    display = eglGetDisplay((EGLNativeDisplayType)x);
    eglInitialize(display, NULL, NULL);
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display, wanted, &config, 1, &count);
    eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &visual_id);
    XVisualInfo wish = {.visualid = (VisualID)visual_id};
    XVisualInfo* visual = XGetVisualInfo(x, VisualIDMask, &wish, &count);
    if (visual == NULL) return 9;
    make_window(visual, width, height);
    surface = eglCreateWindowSurface(display, config, window, NULL);
    eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, NULL));
  }
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  for (int frame = 0; frame < kSizes * kFramesOfEach; ++frame) {
    draw_known_picture(&gl, (unsigned)frame % 3, width, height);
    width = kSize[frame / kFramesOfEach][0];
    height = kSize[frame / kFramesOfEach][1];
    XResizeWindow(x, window, (unsigned)width, (unsigned)height);
    XSync(x, False);
    if (finishes) glFinish();
    if (glx)
      glXSwapBuffers(x, window);
    else
      eglSwapBuffers(display, surface);
    print_shown(frame, width, height);
  }
  return 0;
}
