/* Lonely frames: presents frames of one colour each and does something to its own process in between.
 * Usage: lonely_frames FRAMES [close-streams | close-all FILE | descriptors LIMIT | user | kill]
 * Prints a line per frame to descriptors 0, 1 and 2. close-all opens FILE on many numbers and prints there. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "egl_session.h"

static void close_all(const char* file) {
  for (int descriptor = 3; descriptor < 1024; ++descriptor) close(descriptor);
  const int own = open(file, O_CREAT | O_TRUNC | O_WRONLY | O_APPEND, 0644);
  for (int descriptor = 3; descriptor < 260; ++descriptor)
    if (descriptor != own) dup2(own, descriptor);
}

static void print_everywhere(int frame, int descriptors) {
  for (int descriptor = 0; descriptor < descriptors; ++descriptor)
    dprintf(descriptor, "PROGRAM LINE %d\n", frame);
}

int main(int argc, char** argv) {
  const int frames = argc > 1 ? atoi(argv[1]) : 6;
  const char* deed = argc > 2 ? argv[2] : "";
  int printed_to = strcmp(deed, "close-streams") == 0 ? 3 : 0;
  if (printed_to > 0)
    for (int stream = 0; stream < 3; ++stream) close(stream);
  const EGLDisplay display = open_surfaceless();
  const EGLConfig config = exact_config(display, (channel_bits){8, 8, 8, 8, 0});
  const EGLSurface surface = make_pbuffer(display, config, 64, 64);
  const EGLContext context = make_context(display, config, 2);
  if (!eglMakeCurrent(display, surface, surface, context)) return 9;
  if (strcmp(deed, "descriptors") == 0) {
    const struct rlimit limit = {(rlim_t)atol(argv[3]), (rlim_t)atol(argv[3])};
    if (setrlimit(RLIMIT_NOFILE, &limit) != 0) return 8;
  }
  for (int frame = 0; frame < frames; ++frame) {
    glClearColor((float)frame / 255.0f, 0.5f, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!eglSwapBuffers(display, surface)) return 7;
    if (frame == 1 && strcmp(deed, "close-all") == 0) {
      close_all(argv[3]);
      printed_to = 260;
    }
    if (frame == 1 && strcmp(deed, "user") == 0 && setuid(65534) != 0) return 6;
    print_everywhere(frame, printed_to);
    if (printed_to > 0) usleep(3000);
  }
  if (strcmp(deed, "kill") == 0) {
    usleep(300000);
    kill(getpid(), SIGKILL);
  }
  return 7;
}
