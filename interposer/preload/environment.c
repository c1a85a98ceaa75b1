// Environment: searches environ.
#include "environment.h"

#include <stddef.h>

#include "plain_text.h"

extern char** environ __attribute__((weak));

const char* tp_environment(const char* name) {
  if (&environ == NULL || environ == NULL) return NULL;
  for (char** entry = environ; *entry != NULL; ++entry) {
    const char* value = *entry + tp_length(name);
    if (tp_starts_with(*entry, name) && *value == '=') return value[1] != 0 ? value + 1 : NULL;
  }
  return NULL;
}
