/* egl_scenes SCENE: programs that present from more than one surface. Each scene is a function below. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "covering_triangle.h"
#include "egl_session.h"

static const channel_bits kRgba8 = {8, 8, 8, 8, 0};
static EGLDisplay display;

static void draw_and_swap(EGLSurface surface, unsigned frame, int width, int height) {
  draw_known_picture(&kLinkedGl, frame, width, height);
  if (!eglSwapBuffers(display, surface)) exit(8);
}

static void* present_from_thread(void* argument) {
  const int side = *(const int*)argument;
  EGLConfig config = exact_config(display, kRgba8);
  EGLSurface surface = make_pbuffer(display, config, side, side + 1);
  EGLContext context = make_context(display, config, 2);
  if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
  for (unsigned frame = 0; frame < 12; ++frame) draw_and_swap(surface, frame, side, side + 1);
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  return NULL;
}

/* Four threads, each with a window and a context of its own, at the same time. */
static void threads(void) {
  const int sides[4] = {32, 40, 48, 56};
  pthread_t thread[4];
  for (int i = 0; i < 4; ++i) pthread_create(&thread[i], NULL, present_from_thread, (void*)&sides[i]);
  for (int i = 0; i < 4; ++i) pthread_join(thread[i], NULL);
}

/* Two surfaces that one context alternates between. */
static void alternate(void) {
  EGLConfig config = exact_config(display, kRgba8);
  EGLSurface surface[2] = {make_pbuffer(display, config, 32, 32), make_pbuffer(display, config, 48, 24)};
  EGLContext context = make_context(display, config, 2);
  for (unsigned frame = 0; frame < 10; ++frame) {
    EGLSurface turn = surface[frame % 2];
    eglMakeCurrent(display, turn, turn, context);
    draw_and_swap(turn, frame / 2, frame % 2 != 0 ? 48 : 32, frame % 2 != 0 ? 24 : 32);
  }
}

/* A surface that is destroyed and made again at the same size: a new surface each time. */
static void recreate(void) {
  EGLConfig config = exact_config(display, kRgba8);
  EGLContext context = make_context(display, config, 2);
  for (int round = 0; round < 3; ++round) {
    EGLSurface surface = make_pbuffer(display, config, 32, 32);
    eglMakeCurrent(display, surface, surface, context);
    for (unsigned frame = 0; frame < 4; ++frame) draw_and_swap(surface, frame, 32, 32);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(display, surface);
  }
}

/* The display is terminated and initialized again, with new contexts that may have old addresses. */
static void terminate(void) {
  for (int round = 0; round < 3; ++round) {
    EGLConfig config = exact_config(display, kRgba8);
    EGLSurface surface = make_pbuffer(display, config, 32, 32);
    EGLContext context = make_context(display, config, 2);
    if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
    for (unsigned frame = 0; frame < 4; ++frame) draw_and_swap(surface, frame, 32, 32);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (!eglTerminate(display) || !eglInitialize(display, NULL, NULL)) exit(9);
  }
}

/* A context that is destroyed while current. It lives on until another becomes current. */
static void destroyed(void) {
  EGLConfig config = exact_config(display, kRgba8);
  EGLSurface surface = make_pbuffer(display, config, 32, 32);
  EGLContext context = make_context(display, config, 2);
  if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
  draw_and_swap(surface, 0, 32, 32);
  eglDestroyContext(display, context);
  for (unsigned frame = 1; frame < 4; ++frame) {
    draw_known_picture(&kLinkedGl, frame, 32, 32);
    const EGLBoolean result = eglSwapBuffers(display, surface);
    printf("swap %u 0x%x\n", result, (unsigned)eglGetError());
  }
  printf("GL error 0x%x, EGL error 0x%x, current %d\n", (unsigned)glGetError(), (unsigned)eglGetError(),
         eglGetCurrentContext() == context);
}

/* Swaps that fail: of a surface that is not current, and without a context. Then a swap that succeeds. */
static void failures(void) {
  EGLConfig config = exact_config(display, kRgba8);
  EGLSurface surface = make_pbuffer(display, config, 32, 32), other = make_pbuffer(display, config, 32, 32);
  EGLContext context = make_context(display, config, 2);
  EGLBoolean result = eglSwapBuffers(display, surface);
  printf("no context: %u 0x%x\n", result, (unsigned)eglGetError());
  eglMakeCurrent(display, surface, surface, context);
  result = eglSwapBuffers(display, other);
  printf("not current: %u 0x%x\n", result, (unsigned)eglGetError());
  result = eglSwapBuffers(display, (EGLSurface)0x1234);
  printf("no surface: %u 0x%x\n", result, (unsigned)eglGetError());
  draw_and_swap(surface, 0, 32, 32);
  printf("then: 0x%x\n", (unsigned)eglGetError());
}

/* format RED GREEN BLUE ALPHA FLOAT: five frames of 33x21 in a config with exactly these channels. */
static void format(char** bits) {
  const channel_bits wanted = {atoi(bits[0]), atoi(bits[1]), atoi(bits[2]), atoi(bits[3]), atoi(bits[4])};
  EGLConfig config = exact_config(display, wanted);
  EGLSurface surface = make_pbuffer(display, config, 33, 21);
  EGLContext context = make_context(display, config, 2);
  if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
  const int levels[4] = {wanted.red, wanted.green, wanted.blue, wanted.alpha};
  for (unsigned frame = 0; frame < 5; ++frame) {
    draw_known_levels(&kLinkedGl, frame, 33, 21, levels);
    if (!eglSwapBuffers(display, surface)) exit(8);
  }
}

/* Frames that the program reads and prints itself: a multisampled surface, and one with encoded values. */
static void printed(EGLSurface surface, EGLContext context, void (*print)(int, int)) {
  if (surface == EGL_NO_SURFACE || !eglMakeCurrent(display, surface, surface, context)) exit(77);
  for (unsigned frame = 0; frame < 3; ++frame) {
    draw_covering_triangle(frame);
    print(40, 24);
    if (!eglSwapBuffers(display, surface)) exit(8);
  }
  fprintf(stderr, "0x%x 0x%x\n", (unsigned)glGetError(), (unsigned)eglGetError());
}

static void samples(void) {
  EGLConfig config = sampled_config(display, kRgba8, 4);
  printed(make_pbuffer(display, config, 40, 24), make_context(display, config, 3), print_resolved);
}

static void srgb(void) {
  EGLConfig config = exact_config(display, kRgba8);
  const EGLint encoded[] = {EGL_WIDTH, 40, EGL_HEIGHT, 24, EGL_GL_COLORSPACE, EGL_GL_COLORSPACE_SRGB,
                            EGL_NONE};
  printed(eglCreatePbufferSurface(display, config, encoded), make_context(display, config, 3), print_pixels);
}

/* Like Chromium's allocator: ends the process at a request for a large alignment. */
extern void* __libc_memalign(size_t alignment, size_t size);
__attribute__((visibility("default"))) void* aligned_alloc(size_t alignment, size_t size) {
  if (alignment > 1 << 19) abort();
  return __libc_memalign(alignment, size);
}

/* Frames of a megabyte and more, for which large pages pay. */
static void large(void) {
  EGLConfig config = exact_config(display, kRgba8);
  EGLContext context = make_context(display, config, 2);
  const int sides[3] = {600, 1100, 512};
  for (int i = 0; i < 3; ++i) {
    EGLSurface surface = make_pbuffer(display, config, sides[i], sides[i]);
    if (!eglMakeCurrent(display, surface, surface, context)) exit(9);
    for (unsigned frame = 0; frame < 3; ++frame) draw_and_swap(surface, frame, sides[i], sides[i]);
  }
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  display = open_surfaceless();
  if (strcmp(argv[1], "threads") == 0) threads();
  if (strcmp(argv[1], "alternate") == 0) alternate();
  if (strcmp(argv[1], "recreate") == 0) recreate();
  if (strcmp(argv[1], "terminate") == 0) terminate();
  if (strcmp(argv[1], "destroyed") == 0) destroyed();
  if (strcmp(argv[1], "large") == 0) large();
  if (strcmp(argv[1], "samples") == 0) samples();
  if (strcmp(argv[1], "srgb") == 0) srgb();
  if (strcmp(argv[1], "failures") == 0) failures();
  if (strcmp(argv[1], "format") == 0 && argc > 6) format(argv + 2);
  return 0;
}
