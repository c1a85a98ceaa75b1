/* process_end FRAMES WAY: presents frames of 64x64 and ends in this way. */
#define _GNU_SOURCE
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "egl_session.h"

enum { kSize = 64 };

static EGLDisplay display;
static EGLSurface surface;
static int frame;

static void present_one(void) {
  draw_known_picture(&kLinkedGl, (unsigned)frame++, kSize, kSize);
  if (!eglSwapBuffers(display, surface)) _exit(8);
}

/* The Go runtime does this at the end of main. */
static void* leave_raw(void* unused) {
  syscall(SYS_exit_group, 7);
  return unused;
}

static const char* way = "return";
static void late(void) {
  if (strcmp(way, "handler") == 0) present_one();
}
__attribute__((destructor)) static void latest(void) {
  if (strcmp(way, "destructor") == 0) present_one();
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  way = argv[2];
  display = open_surfaceless();
  const EGLConfig config = exact_config(display, (channel_bits){8, 8, 8, 8, 0});
  surface = make_pbuffer(display, config, kSize, kSize);
  const EGLContext context = make_context(display, config, 2);
  if (!eglMakeCurrent(display, surface, surface, context)) return 9;
  atexit(late); /* before the first frame: the shim's own handler runs earlier */
  for (int left = atoi(argv[1]); left > 0; --left) present_one();

  if (strcmp(way, "raw") == 0) leave_raw(NULL);
  if (strcmp(way, "raw-thread") == 0) {
    pthread_t thread;
    pthread_create(&thread, NULL, leave_raw, NULL);
    for (;;) pause();
  }
  if (strcmp(way, "exec") == 0) execlp("sh", "sh", "-c", "exit 7", (char*)NULL);
  if (strcmp(way, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(way, "kill-group") == 0) {
    setpgid(0, 0);
    kill(0, SIGKILL);
  }
  if (strcmp(way, "abort") == 0) abort();
  if (strcmp(way, "crash") == 0) *(volatile int*)0 = 1;
  if (strcmp(way, "setuid") == 0 && setuid(getuid()) != 0) return 3; /* signals every thread */
  if (strcmp(way, "wait") == 0 && wait(NULL) != -1) return 3;        /* it has no child of its own */
  return 7;
}
