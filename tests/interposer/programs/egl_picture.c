/* egl_picture ROAD FRAMES WIDTH HEIGHT [END]: presents the known picture from a pbuffer, without a window
   system. ROAD: how EGL is reached: link (only in the build that links it), local, deepbind, getproc, dlvsym.
   END: how the program ends: return (default), exit, _exit, _Exit, quick_exit, abort, kill, term, segv
   (signals), pause (presents nothing any more), fork (a child presents too), vfork (a child is executed, then
   as many frames again), dlclose (of the GL library, then as many frames again). Prints the error that
   eglGetError gives after the last swap. */
#define _GNU_SOURCE
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "draw_known_picture.h"

static void* library;
static const char* road;

static void* get(const char* name) {
#ifdef LINKED
  (void)library;
#define LINKED_FUNCTION(function) \
  if (strcmp(name, #function) == 0) return (void*)&function
  LINKED_FUNCTION(eglGetPlatformDisplay);
  LINKED_FUNCTION(eglGetDisplay);
  LINKED_FUNCTION(eglInitialize);
  LINKED_FUNCTION(eglChooseConfig);
  LINKED_FUNCTION(eglCreatePbufferSurface);
  LINKED_FUNCTION(eglCreateContext);
  LINKED_FUNCTION(eglMakeCurrent);
  LINKED_FUNCTION(eglSwapBuffers);
  LINKED_FUNCTION(eglGetError);
  return (void*)eglGetProcAddress(name);
#else
  void* (*get_proc)(const char*) = dlsym(library, "eglGetProcAddress");
  if (strcmp(road, "getproc") == 0 || strncmp(name, "gl", 2) == 0) return get_proc(name);
  if (strcmp(road, "dlvsym") == 0) {
    void* found = dlvsym(library, name, "NO_SUCH_VERSION");
    if (found != NULL) abort();
  }
  return dlsym(library, name);
#endif
}

static int open_library(void) {
#ifndef LINKED
  const int flags = RTLD_NOW | RTLD_LOCAL | (strcmp(road, "deepbind") == 0 ? RTLD_DEEPBIND : 0);
  library = dlopen("libEGL.so.1", flags);
  return library != NULL;
#else
  return 1;
#endif
}

#define GET(name) __typeof__(&egl##name) name = (__typeof__(&egl##name))get("egl" #name)

static void present(int frames, int width, int height) {
  GET(GetPlatformDisplay);
  GET(GetDisplay);
  GET(Initialize);
  GET(ChooseConfig);
  GET(CreatePbufferSurface);
  GET(CreateContext);
  GET(MakeCurrent);
  GET(SwapBuffers);
  GET(GetError);
  const EGLint wanted[] = {EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           8,
                           EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_ES2_BIT,
                           EGL_NONE};
  const EGLint context_wish[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
  EGLDisplay display = GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLConfig config = NULL;
  EGLint count = 0;
  if (!Initialize(display, NULL, NULL)) {  // a driver other than Mesa's
    display = GetDisplay(EGL_DEFAULT_DISPLAY);
    if (!Initialize(display, NULL, NULL)) exit(9);
  }
  if (!ChooseConfig(display, wanted, &config, 1, &count) || count == 0) exit(9);
  EGLSurface surface = CreatePbufferSurface(display, config, size);
  EGLContext context = CreateContext(display, config, EGL_NO_CONTEXT, context_wish);
  if (!MakeCurrent(display, surface, surface, context)) exit(9);
  const draw_functions gl = {(void (*)(GLfloat, GLfloat, GLfloat, GLfloat))get("glClearColor"),
                             (void (*)(GLint, GLint, GLsizei, GLsizei))get("glScissor"),
                             (void (*)(GLenum))get("glEnable"), (void (*)(GLbitfield))get("glClear")};
  for (int frame = 0; frame < frames; ++frame) {
    draw_known_picture(&gl, (unsigned)frame, width, height);
    if (!SwapBuffers(display, surface)) exit(8);
  }
  printf("error after the last swap: 0x%x\n", (unsigned)GetError());
  fflush(stdout);
}

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  road = argv[1];
  const int frames = atoi(argv[2]), width = atoi(argv[3]), height = atoi(argv[4]);
  const char* end = argc > 5 ? argv[5] : "return";
  if (!open_library()) return 9;
  if (strcmp(end, "fork") == 0 && fork() == 0) {
    present(frames + 2, width, height);
    _exit(0);
  }
  present(frames, width, height);
  if (strcmp(end, "exit") == 0) exit(7);
  if (strcmp(end, "_exit") == 0) _exit(7);
  if (strcmp(end, "_Exit") == 0) _Exit(7);
  if (strcmp(end, "quick_exit") == 0) quick_exit(7);
  while (strcmp(end, "pause") == 0) pause();
  if (strcmp(end, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(end, "abort") == 0) abort();
  if (strcmp(end, "term") == 0) raise(SIGTERM);
  if (strcmp(end, "segv") == 0) raise(SIGSEGV);
  if (strcmp(end, "vfork") == 0) {
    if (vfork() == 0) {
      execlp("sh", "sh", "-c", "echo child", (char*)NULL);
      _exit(127);
    }
    wait(NULL);
    present(frames, width, height);
  }
  if (strcmp(end, "dlclose") == 0) {
    if (library == NULL || dlclose(library) != 0 || !open_library()) return 9;
    present(frames, width, height);
  }
  if (strcmp(end, "fork-after") == 0 && fork() == 0) {
    present(frames + 2, width, height);
    return 0;
  }
  while (wait(NULL) > 0) {
  }
  return 0;
}
