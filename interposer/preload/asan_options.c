// ASan options: the address sanitizer's shared runtime (gcc's, clang's -shared-libsan) ends a program in
// which another library was loaded before it, and a preloaded library always is. It has a flag for
// preloading, and asks this function for flags before it reads ASAN_OPTIONS. Reaches programs whose parent
// has set that variable itself. The program's own definition comes first; the launcher sets the variable for
// those that have one.
#include <stddef.h>

#include "c_library.h"
#include "plain_text.h"

__attribute__((visibility("default"))) const char* __asan_default_options(void);
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
