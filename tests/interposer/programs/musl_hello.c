/* musl_hello [END]: looks symbols up and ends with 7, by return, _exit or _Exit. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char** argv) {
  printf("puts %d\n", dlsym(RTLD_DEFAULT, "puts") != NULL);
  printf("next puts %d\n", dlsym(RTLD_NEXT, "puts") != NULL);
  printf("eglSwapBuffers %d\n", dlsym(RTLD_DEFAULT, "eglSwapBuffers") != NULL);
  printf("error %d\n", dlerror() != NULL);
  fflush(stdout);
  if (argc > 1 && strcmp(argv[1], "_exit") == 0) _exit(7);
  if (argc > 1 && strcmp(argv[1], "_Exit") == 0) _Exit(7);
  return 7;
}
