// Exits: programs that end by _exit run no destructor; their last frames are written out first.
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "engine_loader.h"

__attribute__((noreturn)) static void drain_and_exit(int status) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine != NULL) engine->finish();
  for (;;) syscall(SYS_exit_group, status);
}

__attribute__((visibility("default"), noreturn)) void _exit(int status) {
  drain_and_exit(status);
}
__attribute__((visibility("default"), noreturn)) void _Exit(int status) {
  drain_and_exit(status);
}
