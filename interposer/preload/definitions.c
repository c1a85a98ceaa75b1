// Definitions: searches behind this library in load order first, as the dynamic linker would.
#define _GNU_SOURCE
#include "definitions.h"

#include <dlfcn.h>
#include <stddef.h>

#include "c_library.h"
#include "elf_symbols.h"
#include "plain_text.h"

void tp_pin_library_of(void* function) {
  char path[4096];
  if (!tp_path_of_object(function, path, sizeof path) || tp_base_name(path) == path) return;
  tp_c_library()->dlopen(path, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  tp_c_library()->dlerror();
}

static void* next_or_the_callers(const char* name, void* caller) {
  const struct tp_c_library* library = tp_c_library();
  if (library == NULL) return NULL;
  void* found = library->dlsym(RTLD_NEXT, name);
  if (found == NULL) {
    // The caller may be a plugin with a GL library of its own, which the global scope does not show.
    void* object = tp_handle_of_object(caller);
    if (object != NULL) found = library->dlsym(object, name);
    if (found != NULL && tp_is_ours(found)) found = NULL;
  }
  library->dlerror();
  return found;
}

void* tp_definition_after_ours(const char* name, void* caller, void* known) {
  void* found = next_or_the_callers(name, caller);
  if (found == NULL) found = known;
  if (found == NULL) found = tp_symbol_anywhere(name, NULL);
  if (found != NULL) tp_pin_library_of(found);
  return found;
}

void* tp_beneath_caller(const char* name, void* found, void* caller) {
  return tp_same_object(found, caller) ? tp_symbol_anywhere(name, found) : found;
}
