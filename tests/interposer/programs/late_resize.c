/* late_resize egl|glx [finish|pulled]: an X window whose size changes when a frame has been drawn but not
 * presented, as when somebody pulls at its frame: 3 frames of each size. Prints what the window shows after
 * each. Never larger than before: Mesa's EGL shows memory beyond its buffer then. pulled: 400 frames, while
 * another client gives the window other sizes all the time. */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xutil.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

static EGLDisplay display = EGL_NO_DISPLAY;
static EGLSurface surface = EGL_NO_SURFACE;

static bool open_glx(int width, int height) {
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
  XVisualInfo* visual = glXChooseVisual(x, DefaultScreen(x), wanted);
  if (visual == NULL) return false;
  make_window(visual, width, height);
  return glXMakeCurrent(x, window, glXCreateContext(x, visual, NULL, True));
}

static bool open_egl(int width, int height) {
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
  int count = 0;
  display = eglGetDisplay((EGLNativeDisplayType)x);
  eglInitialize(display, NULL, NULL);
  eglBindAPI(EGL_OPENGL_API);
  eglChooseConfig(display, wanted, &config, 1, &count);
  eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &visual_id);
  XVisualInfo wish = {.visualid = (VisualID)visual_id};
  XVisualInfo* visual = XGetVisualInfo(x, VisualIDMask, &wish, &count);
  if (visual == NULL) return false;
  make_window(visual, width, height);
  surface = eglCreateWindowSurface(display, config, window, NULL);
  return eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, NULL));
}

static void swap(void) {
  if (display != EGL_NO_DISPLAY)
    eglSwapBuffers(display, surface);
  else
    glXSwapBuffers(x, window);
}

static atomic_bool ends;

static void* pull(void* unused) {
  Display* other = XOpenDisplay(NULL);
  for (unsigned step = 0; other != NULL && !ends; ++step) {
    XResizeWindow(other, window, 40 + step * 7 % 31, 40 + step * 5 % 23);
    XSync(other, False);
    nanosleep(&(struct timespec){.tv_nsec = 500000}, NULL);
  }
  if (other != NULL) XCloseDisplay(other);
  return unused;
}

int main(int argc, char** argv) {
  enum { kSizes = 4, kFramesOfEach = 3, kFramesPulled = 400 };
  static const int kSize[kSizes][2] = {{60, 61}, {33, 48}, {32, 40}, {20, 17}};
  const bool glx = argc > 1 && strcmp(argv[1], "glx") == 0;
  const bool finishes = argc > 2 && strcmp(argv[2], "finish") == 0, pulled = argc > 2 && !finishes;
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  int width = 64, height = 70;
  x = XOpenDisplay(NULL);
  if (x == NULL || !(glx ? open_glx(width, height) : open_egl(width, height))) return 9;
  pthread_t other;
  if (pulled && pthread_create(&other, NULL, pull, NULL) != 0) return 9;
  for (int frame = 0; pulled && frame < kFramesPulled; ++frame) {
    draw_known_picture(&gl, 0, width, height);
    swap();
  }
  ends = true;
  if (pulled) return pthread_join(other, NULL);
  for (int frame = 0; frame < kSizes * kFramesOfEach; ++frame) {
    draw_known_picture(&gl, (unsigned)frame % 3, width, height);
    width = kSize[frame / kFramesOfEach][0];
    height = kSize[frame / kFramesOfEach][1];
    XResizeWindow(x, window, (unsigned)width, (unsigned)height);
    XSync(x, False);
    if (finishes) glFinish();
    swap();
    print_shown(frame, width, height);
  }
  return 0;
}
