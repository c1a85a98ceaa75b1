/* glx_idle MODE: draws the known picture in two windows of 64x48 and 48x40, three frames each, and presents
   them while they are not current on the calling thread. Prints what is current afterwards and the X errors.
   other: by turns: while one is presented the other is current, both windows made for GLX. released: nothing
   is current. thread: another thread presents while this one has the window current. after: another thread
   presents while this one waits with nothing current. plain: as other, with plain X windows, which has Mesa
   raise an error. sometimes: as other, but each is current when its second frame is presented. */
#include <GL/glx.h>
#include <X11/Xutil.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "draw_known_picture.h"

static const int kWidth[2] = {64, 48}, kHeight[2] = {48, 40};
static Display* display;
static GLXDrawable drawables[2];
static int errors;

static int count_error(Display* of, XErrorEvent* error) {
  (void)of;
  printf("X error %d of request %d.%d\n", error->error_code, error->request_code, error->minor_code);
  return ++errors;
}

/* What the X server shows at the top left. */
static unsigned long shown(Window window) {
  XImage* image = XGetImage(display, window, 1, 1, 1, 1, AllPlanes, ZPixmap);
  const unsigned long pixel = XGetPixel(image, 0, 0) & 0xFFFFFF;
  XDestroyImage(image);
  return pixel;
}

static void* swap_both(void* unused) {
  (void)unused;
  for (int i = 0; i < 2; ++i) glXSwapBuffers(display, drawables[i]);
  return NULL;
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const char* mode = argv[1];
  XInitThreads();
  XSetErrorHandler(count_error);
  display = XOpenDisplay(NULL);
  if (display == NULL) return 9;
  const int wanted[] = {GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_DOUBLEBUFFER, True, None};
  int count = 0;
  GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
  if (count == 0) return 77;
  XVisualInfo* visual = glXGetVisualFromFBConfig(display, configs[0]);
  const Window root = DefaultRootWindow(display);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
  Window windows[2];
  for (int i = 0; i < 2; ++i) {
    windows[i] =
        XCreateWindow(display, root, 0, 100 * i, (unsigned)kWidth[i], (unsigned)kHeight[i], 0, visual->depth,
                      InputOutput, visual->visual, CWColormap | CWBorderPixel, &attributes);
    XMapWindow(display, windows[i]);
    drawables[i] =
        strcmp(mode, "plain") == 0 ? windows[i] : glXCreateWindow(display, configs[0], windows[i], NULL);
  }
  XSync(display, False);
  GLXContext context = glXCreateNewContext(display, configs[0], GLX_RGBA_TYPE, NULL, True);
  const draw_functions gl = {glClearColor, glScissor, glEnable, glClear};
  for (unsigned frame = 0; frame < 3; ++frame) {
    for (int i = 0; i < 2; ++i) {
      glXMakeContextCurrent(display, drawables[i], drawables[i], context);
      draw_known_picture(&gl, frame, kWidth[i], kHeight[i]);
      if (strcmp(mode, "sometimes") == 0 && frame == 1) glXSwapBuffers(display, drawables[i]);
    }
    if (strcmp(mode, "released") == 0 || strcmp(mode, "after") == 0) glXMakeCurrent(display, None, NULL);
    pthread_t thread;
    if (strcmp(mode, "thread") == 0 || strcmp(mode, "after") == 0) {
      pthread_create(&thread, NULL, swap_both, NULL);
      pthread_join(thread, NULL);
    } else if (strcmp(mode, "sometimes") != 0 || frame != 1) {
      swap_both(NULL);
    }
    XSync(display, False);
    printf("shown %06lx %06lx, ", shown(windows[0]), shown(windows[1]));
    printf("current %d %d\n", glXGetCurrentContext() == context, glXGetCurrentDrawable() == drawables[1]);
  }
  printf("errors %d\n", errors);
  return 0;
}
