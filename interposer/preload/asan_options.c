// ASan options: the address sanitizer's shared runtime (gcc's, and clang's with -shared-libsan) ends a
// program in which another library was loaded first. A preloaded library always is. The runtime has a flag
// for this case, and calls this function for flags before it reads ASAN_OPTIONS. The launcher sets that
// variable too. The function serves programs whose parent replaces the variable. A program's own definition
// comes first.
#include <stddef.h>

#include "c_library.h"
#include "plain_text.h"

__attribute__((visibility("default"))) const char* __asan_default_options(void) {
  static char bytes[4096];
  struct tp_text options = {bytes, sizeof bytes, 0, false};
  const char* (*next)(void) = NULL;
  *(void**)&next = tp_function_behind_ours("__asan_default_options");
  tp_append(&options, "verify_asan_link_order=0");
  const char* further = next != NULL ? next() : NULL;
  if (further == NULL) return bytes;
  tp_append(&options, ":");
  tp_append(&options, further);
  return options.cut ? further : bytes;
}
