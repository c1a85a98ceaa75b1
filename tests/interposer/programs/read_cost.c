/* read_cost WIDTH HEIGHT FRAMES: draws each frame twice; reads it with a bare glReadPixels in the
   implementation's own format, then presents it, which the shim reads. Prints the nanoseconds of the bare
   read, a line per frame. Rendering has ended before either. */
#include <stdio.h>
#include <time.h>

#include "egl_session.h"

static long long now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const channel_bits bits = {8, 8, 8, 8, 0};
  const int width = atoi(argv[1]), height = atoi(argv[2]), frames = atoi(argv[3]);
  EGLDisplay display = open_surfaceless();
  EGLConfig config = exact_config(display, bits);
  EGLSurface surface = make_pbuffer(display, config, width, height);
  if (!eglMakeCurrent(display, surface, surface, make_context(display, config, 2))) return 9;
  GLint format = GL_RGBA, type = GL_UNSIGNED_BYTE;
  glGetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &format);
  glGetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &type);
  void* pixels = malloc((size_t)width * (size_t)height * 4);
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&kLinkedGl, (unsigned)frame, width, height);
    glFinish();
    const long long begin_ns = now_ns();
    glReadPixels(0, 0, width, height, (GLenum)format, (GLenum)type, pixels);
    printf("%lld\n", now_ns() - begin_ns);
    draw_known_picture(&kLinkedGl, (unsigned)frame, width, height);
    glFinish();
    if (!eglSwapBuffers(display, surface)) return 8;
  }
  free(pixels);
  return 0;
}
