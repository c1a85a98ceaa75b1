// Exits: a program that ends by _exit runs no destructor. The engine writes its last frames first.
#define _GNU_SOURCE
#include <stdlib.h>
#include <unistd.h>

#include "../system_calls.h"
#include "c_library.h"
#include "engine_loader.h"

typedef void (*exit_function)(int status);

// The next definition may be a sanitizer's. It prints its report and may change the status.
__attribute__((noreturn)) static void drain_and_exit(const char* name, int status) {
  const struct TilepressEngine* engine = tp_loaded_engine();
  if (engine != NULL) engine->finish();
  exit_function next;
  *(void**)&next = tp_function_behind_ours(name);
  if (next != NULL) next(status);
  for (;;) tp_system_call(SYS_exit_group, status, 0, 0, 0);
}

__attribute__((visibility("default"), noreturn)) void _exit(int status) {
  drain_and_exit("_exit", status);
}
__attribute__((visibility("default"), noreturn)) void _Exit(int status) {
  drain_and_exit("_Exit", status);
}
