/* glx_resize: presents the known picture in an X window whose size changes between frames: 3 frames of each
 * size. */
#include <GL/glx.h>
#include <stdio.h>
#include <stdlib.h>

#include "draw_known_picture.h"

static int calls_of_error_handler;

static int count_error(Display* display, XErrorEvent* event) {
  (void)display, (void)event;
  ++calls_of_error_handler;
  return 0;
}

int main(void) {
  static const int kSizes[4][2] = {{64, 48}, {80, 40}, {33, 77}, {64, 48}};
  Display* display = XOpenDisplay(NULL);
  if (display == NULL) return 9;
  XSetErrorHandler(count_error);
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
  XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), wanted);
  if (visual == NULL) return 9;
  const Window root = DefaultRootWindow(display);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
  Window window = XCreateWindow(display, root, 0, 0, 64, 48, 0, visual->depth, InputOutput, visual->visual,
                                CWColormap | CWBorderPixel, &attributes);
  XMapWindow(display, window);
  GLXContext context = glXCreateContext(display, visual, NULL, True);
  glXMakeCurrent(display, window, context);
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  for (unsigned frame = 0; frame < 12; ++frame) {
    const int* size = kSizes[frame / 3];
    XResizeWindow(display, window, (unsigned)size[0], (unsigned)size[1]);
    XSync(display, False);
    glViewport(0, 0, size[0], size[1]);
    draw_known_picture(&gl, frame % 3, size[0], size[1]);
    glXSwapBuffers(display, window);
  }
  glXMakeCurrent(display, None, NULL);
  glXDestroyContext(display, context);
  XCloseDisplay(display);
  printf("X errors: %d\n", calls_of_error_handler);
  return 0;
}
