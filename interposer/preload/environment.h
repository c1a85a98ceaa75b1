// Environment: reads variables without getenv. Shells and sandboxes define a getenv of their own.
#pragma once

#include <stddef.h>

#include "plain_text.h"

extern char** environ __attribute__((weak));

// Returns the value of a variable; NULL if it is not set or empty.
static inline const char* tp_environment(const char* name) {
  if (&environ == NULL || environ == NULL) return NULL;
  for (char** entry = environ; *entry != NULL; ++entry) {
    const char* value = *entry + tp_length(name);
    if (tp_starts_with(*entry, name) && *value == '=') return value[1] != 0 ? value + 1 : NULL;
  }
  return NULL;
}
