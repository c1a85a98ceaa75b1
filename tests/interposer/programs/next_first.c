/* next_first: the earlier library in load order. It looks up the next definition of its own function. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>

int probe_number(void);
int probe_number(void) {
  int (*next)(void) = (int (*)(void))dlsym(RTLD_NEXT, "probe_number");
  return next != NULL ? 10 + next() : 1;
}
