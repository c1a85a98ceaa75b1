/* glx_picture FRAMES WIDTH HEIGHT: presents the known picture in an X window, through a linked libGL. */
#include <GL/glx.h>
#include <stdio.h>
#include <stdlib.h>

#include "draw_known_picture.h"

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const int frames = atoi(argv[1]), width = atoi(argv[2]), height = atoi(argv[3]);
  Display* display = XOpenDisplay(NULL);
  if (display == NULL) return 9;
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
  XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), wanted);
  if (visual == NULL) return 9;
  const Window root = DefaultRootWindow(display);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone),
                                     .border_pixel = 0};
  Window window = XCreateWindow(display, root, 0, 0, (unsigned)width, (unsigned)height, 0, visual->depth,
                                InputOutput, visual->visual, CWColormap | CWBorderPixel, &attributes);
  XMapWindow(display, window);
  GLXContext context = glXCreateContext(display, visual, NULL, True);
  glXMakeCurrent(display, window, context);
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&gl, (unsigned)frame, width, height);
    glXSwapBuffers(display, window);
  }
  printf("error after the last swap: 0x%x\n", glGetError());
  glXMakeCurrent(display, None, NULL);
  glXDestroyContext(display, context);
  XCloseDisplay(display);
  return 0;
}
