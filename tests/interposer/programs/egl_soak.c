/* egl_soak FRAMES: presents from surfaces and contexts that are made anew every ten frames, at changing
   sizes, and prints resident memory and open descriptors after a tenth of the frames and at the end. */
#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

#include "egl_session.h"

static long resident_kib(void) {
  long pages = 0, resident = 0;
  FILE* file = fopen("/proc/self/statm", "r");
  if (file == NULL || fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = -1;
  if (file != NULL) fclose(file);
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

static int open_descriptors(void) {
  int count = -3; /* the two dots, and the folder's own */
  DIR* folder = opendir("/proc/self/fd");
  while (folder != NULL && readdir(folder) != NULL) ++count;
  if (folder != NULL) closedir(folder);
  return count;
}

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
      if (frame == frames / 10) printf("%ld KiB, %d descriptors\n", resident_kib(), open_descriptors());
    }
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    eglDestroySurface(display, surface);
  }
  printf("%ld KiB, %d descriptors\n", resident_kib(), open_descriptors());
  return 0;
}
