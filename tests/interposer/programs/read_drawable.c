/* read_drawable API SCENE: draws the known picture to surface A while surface B is the one that is read from,
   and presents A, three frames. Prints what the calls answer and what B holds after each frame. API: glx
   (plain X windows), glxwindow, glxpbuffer, glxpixmap; gl, es1, es2, es3 (EGL pbuffers); x-gl, x-es3 (EGL
   windows). SCENE: smaller, larger (B), config (B has no alpha, or none of A's other bits), destroyed (B,
   while current), read (B is presented, by GLX), resized (A becomes smaller after each drawing; prints what
   it shows), front (A's front buffer, and glFinish), finish, readpixels (in place of presenting), elsewhere
   (another thread, where nothing is current, presents A). */
#define GL_GLEXT_PROTOTYPES
#include "egl_session.h"

#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xutil.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { kWidth = 33, kHeight = 21, kFrames = 3 };

static const char *api, *scene;
static Display* x;
static EGLDisplay display;
static Window window[2];
static GLXDrawable drawable[2];
static EGLSurface surface[2];
static GLXContext glx_context;
static EGLContext egl_context;
static int width[2] = {kWidth, kWidth}, height[2] = {kHeight, kHeight};

static int is(const char* text) {
  return strcmp(scene, text) == 0;
}

static void open_x(void) {
  x = XOpenDisplay(NULL);
  if (x == NULL) exit(9);
}

static void make_window(int i, XVisualInfo* visual) {
  const Window root = DefaultRootWindow(x);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(x, root, visual->visual, AllocNone)};
  window[i] = XCreateWindow(x, root, 100 * i, 0, (unsigned)width[i], (unsigned)height[i], 0, visual->depth,
                            InputOutput, visual->visual, CWColormap | CWBorderPixel, &attributes);
  XMapWindow(x, window[i]);
  XSync(x, False);
}

static GLXFBConfig glx_config(int alpha, int depth) {
  const int wanted[] = {GLX_RED_SIZE,
                        8,
                        GLX_ALPHA_SIZE,
                        alpha,
                        GLX_DEPTH_SIZE,
                        depth,
                        GLX_DOUBLEBUFFER,
                        True,
                        GLX_SAMPLES,
                        0,
                        GLX_DRAWABLE_TYPE,
                        GLX_WINDOW_BIT | GLX_PBUFFER_BIT | GLX_PIXMAP_BIT,
                        None};
  int count = 0;
  GLXFBConfig* found = glXChooseFBConfig(x, DefaultScreen(x), wanted, &count);
  for (int i = 0; i < count; ++i) {
    int bits = 0;
    glXGetFBConfigAttrib(x, found[i], GLX_ALPHA_SIZE, &bits);
    if (bits == alpha) return found[i];
  }
  exit(77);
}

static void open_glx(void) {
  open_x();
  for (int i = 0; i < 2; ++i) {
    const int other = is("config") && i == 1;
    const GLXFBConfig config = glx_config(8, other ? 0 : 24);
    XVisualInfo* visual = glXGetVisualFromFBConfig(x, config);
    const int size[] = {GLX_PBUFFER_WIDTH, width[i], GLX_PBUFFER_HEIGHT, height[i], None};
    make_window(i, visual);
    if (strcmp(api, "glx") == 0) drawable[i] = window[i];
    if (strcmp(api, "glxwindow") == 0) drawable[i] = glXCreateWindow(x, config, window[i], NULL);
    if (strcmp(api, "glxpbuffer") == 0) drawable[i] = glXCreatePbuffer(x, config, size);
    if (strcmp(api, "glxpixmap") == 0)
      drawable[i] = glXCreatePixmap(
          x, config,
          XCreatePixmap(x, window[i], (unsigned)width[i], (unsigned)height[i], (unsigned)visual->depth),
          NULL);
    if (i == 0) glx_context = glXCreateNewContext(x, config, GLX_RGBA_TYPE, NULL, True);
  }
}

static EGLConfig x_config(EGLint renderable) {
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_WINDOW_BIT,
                           EGL_RENDERABLE_TYPE,
                           renderable,
                           EGL_RED_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           0,
                           EGL_SAMPLES,
                           0,
                           EGL_NONE};
  EGLConfig config = NULL;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) exit(77);
  return config;
}

static void open_egl(void) {
  const int on_x = strncmp(api, "x-", 2) == 0;
  const char* name = api + 2 * on_x;
  const int embedded = strncmp(name, "es", 2) == 0;
  const channel_bits bits = {8, 8, 8, 8, 0}, opaque = {8, 8, 8, 0, 0};
  if (on_x) {
    open_x();
    display = eglGetDisplay((EGLNativeDisplayType)x);
    if (!eglInitialize(display, NULL, NULL)) exit(9);
  } else {
    display = open_surfaceless();
  }
  if (!embedded) eglBindAPI(EGL_OPENGL_API);
  for (int i = 0; i < 2; ++i) {
    EGLConfig config = NULL;
    if (on_x) {
      config = x_config(embedded ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT);
      XVisualInfo wish = {0};
      EGLint id = 0;
      int count = 0;
      eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &id);
      wish.visualid = (VisualID)id;
      make_window(i, XGetVisualInfo(x, VisualIDMask, &wish, &count));
      surface[i] = eglCreateWindowSurface(display, config, window[i], NULL);
    } else {
      config = exact_config(display, is("config") && i == 1 ? opaque : bits);
      surface[i] = make_pbuffer(display, config, width[i], height[i]);
    }
    if (i == 0)
      egl_context = embedded ? make_context(display, config, atoi(name + 2))
                             : eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
  }
}

static void make_current(int draw, int read) {
  const int done = glx_context != NULL
                       ? glXMakeContextCurrent(x, drawable[draw], drawable[read], glx_context)
                       : (int)eglMakeCurrent(display, surface[draw], surface[read], egl_context);
  if (!done) printf("draw %d read %d cannot be current\n", draw, read);
}

static void draw(unsigned frame, int i) {
  draw_known_picture(&kLinkedGl, frame, width[i], height[i]);
}

static unsigned hash_of_read(void) {
  static unsigned char pixels[200 * 200 * 4];
  unsigned hash = 0;
  memset(pixels, 0, sizeof pixels);
  glReadPixels(0, 0, width[1], height[1], GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  for (int i = 0; i < 4 * width[1] * height[1]; ++i) hash = hash * 33 + pixels[i];
  return hash;
}

static void present(int i) {
  if (is("front") || is("finish"))
    glFinish();
  else if (is("readpixels"))
    (void)hash_of_read();
  else if (glx_context != NULL)
    glXSwapBuffers(x, drawable[i]);
  else
    printf("swap %u, EGL error 0x%x\n", eglSwapBuffers(display, surface[i]), (unsigned)eglGetError());
}

static void* present_elsewhere(void* unused) {
  present(0);
  return unused;
}

static void print_state(unsigned frame) {
  const int same =
      glx_context != NULL
          ? glXGetCurrentDrawable() == drawable[0] && glXGetCurrentReadDrawable() == drawable[1]
          : eglGetCurrentSurface(EGL_DRAW) == surface[0] && eglGetCurrentSurface(EGL_READ) == surface[1];
  printf("frame %u: current %d, B %08x, error 0x%x\n", frame, same, hash_of_read(), glGetError());
}

static void print_shown(void) {
  XSync(x, False);
  XImage* image = XGetImage(x, window[0], 0, 0, (unsigned)width[0], (unsigned)height[0], AllPlanes, ZPixmap);
  unsigned hash = 0;
  for (int row = 0; image != NULL && row < height[0]; ++row)
    for (int column = 0; column < width[0]; ++column)
      hash = hash * 33 + ((unsigned)XGetPixel(image, column, row) & 0xFFFFFF);
  printf("A shows %08x\n", hash);
}

static void destroy_read(void) {
  if (strcmp(api, "glx") == 0) XDestroyWindow(x, window[1]);
  if (strcmp(api, "glxwindow") == 0) glXDestroyWindow(x, drawable[1]);
  if (strcmp(api, "glxpbuffer") == 0) glXDestroyPbuffer(x, drawable[1]);
  if (glx_context == NULL) eglDestroySurface(display, surface[1]);
  if (x != NULL) XSync(x, False);
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  api = argv[1];
  scene = argv[2];
  if (is("smaller")) width[1] = height[1] = 16;
  if (is("larger") || is("read") || is("readpixels")) width[1] = height[1] = 40;
  (strncmp(api, "glx", 3) == 0 ? open_glx : open_egl)();
  make_current(1, 1);
  draw(50, 1);
  make_current(0, 1);
  if (is("front")) glDrawBuffer(GL_FRONT);
  if (is("destroyed")) destroy_read();
  for (unsigned frame = 0; frame < kFrames; ++frame) {
    draw(frame, 0);
    if (is("resized")) {
      width[0] -= 5;
      height[0] -= 2;
      XResizeWindow(x, window[0], (unsigned)width[0], (unsigned)height[0]);
      XSync(x, False);
    }
    pthread_t thread;
    if (is("elsewhere") && pthread_create(&thread, NULL, present_elsewhere, NULL) == 0)
      pthread_join(thread, NULL);
    else
      present(is("read"));
    if (is("resized")) print_shown();
    if (is("destroyed"))
      printf("error 0x%x\n", glGetError());
    else
      print_state(frame);
  }
  return 0;
}
