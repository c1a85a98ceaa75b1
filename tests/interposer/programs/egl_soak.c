/* egl_soak FRAMES: presents from surfaces and contexts that are made anew every ten frames, at changing
   sizes, and prints resident memory and open descriptors after a tenth of the frames and at the end. */
#include "egl_session.h"
#include "process_size.h"

int main(int argc, char** argv) {
  const channel_bits bits = {8, 8, 8, 8, 0};
  const unsigned frames = argc > 1 ? (unsigned)atoi(argv[1]) : 1000;
  EGLDisplay display = open_surfaceless();
  EGLConfig config = exact_config(display, bits);
  for (unsigned frame = 0; frame < frames;) {
    const int width = 32 + (int)(frame / 10 % 7) * 16, height = 40 + (int)(frame / 10 % 5) * 8;
    EGLSurface surface = make_pbuffer(display, config, width, height);
    EGLContext context = make_context(display, config, 2);
    if (!eglMakeCurrent(display, surface, surface, context)) return 9;
    for (int i = 0; i < 10; ++i, ++frame) {
      draw_known_picture(&kLinkedGl, frame, width, height);
      if (!eglSwapBuffers(display, surface)) return 8;
      if (frame == frames / 10) print_process_size();
    }
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    eglDestroySurface(display, surface);
  }
  print_process_size();
  return 0;
}
