/* window_soak egl|glx CYCLES: each cycle makes an X window and a context, presents two frames, resizes the
   window, presents two more and destroys both. Prints the process's size after a fifth of the cycles and at
   the end, and the name that the driver gives to a new texture in the last context: what others make there
   would raise it. */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>
#include <stdlib.h>
#include <string.h>

#include "process_size.h"

static Display* x;

static Window make_window(const XVisualInfo* visual, int width, int height) {
  const Window root = DefaultRootWindow(x);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(x, root, visual->visual, AllocNone)};
  const Window window = XCreateWindow(x, root, 0, 0, (unsigned)width, (unsigned)height, 0, visual->depth,
                                      InputOutput, visual->visual, CWColormap | CWBorderPixel, &attributes);
  XMapWindow(x, window);
  XSync(x, False);
  XFreeColormap(x, attributes.colormap);
  return window;
}

static void draw(unsigned frame) {
  glClearColor((float)(frame % 7) / 7, (float)(frame % 11) / 11, 0.5f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

static void resize(Window window, unsigned cycle) {
  XResizeWindow(x, window, 40 + cycle % 5 * 16, 40 + cycle % 3 * 24);
  XSync(x, False);
}

static GLuint texture_name(void) {
  GLuint name = 0;
  glGenTextures(1, &name);
  return name;
}

static GLuint glx_cycle(const XVisualInfo* visual, unsigned cycle) {
  const Window window = make_window(visual, 64, 48);
  GLXContext context = glXCreateContext(x, (XVisualInfo*)visual, NULL, True);
  if (!glXMakeCurrent(x, window, context)) exit(9);
  for (unsigned frame = 0; frame < 4; ++frame) {
    if (frame == 2) resize(window, cycle);
    draw(4 * cycle + frame);
    glXSwapBuffers(x, window);
  }
  const GLuint name = texture_name();
  glXMakeCurrent(x, None, NULL);
  glXDestroyContext(x, context);
  XDestroyWindow(x, window);
  return name;
}

static GLuint egl_cycle(EGLDisplay display, EGLConfig config, const XVisualInfo* visual, unsigned cycle) {
  const Window window = make_window(visual, 64, 48);
  EGLSurface surface = eglCreateWindowSurface(display, config, window, NULL);
  const EGLint wish[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, wish);
  if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
  for (unsigned frame = 0; frame < 4; ++frame) {
    if (frame == 2) resize(window, cycle);
    draw(4 * cycle + frame);
    if (!eglSwapBuffers(display, surface)) exit(8);
  }
  const GLuint name = texture_name();
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
  eglDestroySurface(display, surface);
  XDestroyWindow(x, window);
  return name;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int with_egl = strcmp(argv[1], "egl") == 0;
  const unsigned cycles = (unsigned)atoi(argv[2]);
  x = XOpenDisplay(NULL);
  if (x == NULL) return 9;
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, None};
  XVisualInfo* visual = NULL;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = NULL;
  if (with_egl) {
    const EGLint attributes[] = {EGL_SURFACE_TYPE,    EGL_WINDOW_BIT,     EGL_RED_SIZE, 8,
                                 EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_NONE};
    EGLint count = 0, id = 0;
    display = eglGetDisplay((EGLNativeDisplayType)x);
    if (!eglInitialize(display, NULL, NULL)) return 9;
    eglChooseConfig(display, attributes, &config, 1, &count);
    eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &id);
    XVisualInfo like = {.visualid = (VisualID)id};
    visual = XGetVisualInfo(x, VisualIDMask, &like, &count);
  } else {
    visual = glXChooseVisual(x, DefaultScreen(x), wanted);
  }
  if (visual == NULL) return 9;
  GLuint name = 0;
  for (unsigned cycle = 0; cycle < cycles; ++cycle) {
    name = with_egl ? egl_cycle(display, config, visual, cycle) : glx_cycle(visual, cycle);
    if (cycle == cycles / 5) print_process_size();
  }
  print_process_size();
  printf("texture %u\n", name);
  return 0;
}
