/* early_lookup: a library that looks symbols up while the dynamic linker relocates it. Libraries loaded earlier,
   the shim too, are not relocated yet. -fno-plt makes the address of dlsym available by then. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>

static int one(void) {
  return 1;
}
static int two(void) {
  return 2;
}

static int (*choose(void))(void) {
  const int answers = (dlsym(RTLD_DEFAULT, "glob") != NULL) + (dlsym(RTLD_DEFAULT, "glNoSuchFunction") == NULL);
  return answers == 2 ? two : one;
}

static int chosen(void) __attribute__((ifunc("choose")));
static int (*volatile early)(void) = chosen;

int early_answer(void);
int early_answer(void) {
  return early();
}
