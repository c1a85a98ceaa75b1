// Entry points: the tables that follow from the list, and the search for a name.
#include "entry_points.h"

#include <stddef.h>

#include "plain_text.h"

const char tp_entry_names[TP_ENTRY_COUNT][TP_ENTRY_NAME_SIZE] = {
#define TP_ENTRY(name, ...) #name,
#include "entry_points.def"
};

const unsigned char tp_entry_kinds[TP_ENTRY_COUNT] = {
#define TP_ENTRY(name, kind, ...) TP_##kind,
#include "entry_points.def"
};

#define TP_ENTRY(name, ...) \
  _Static_assert(sizeof #name <= TP_ENTRY_NAME_SIZE, #name " is longer than TP_ENTRY_NAME_SIZE");
#include "entry_points.def"

// The bisection needs sorted names: each line closes a comparison with the name before and opens the next.
// clang-format off
#define TP_ENTRY(name, ...) #name) < 0, #name " is out of order"); _Static_assert(__builtin_strcmp(#name,
_Static_assert(__builtin_strcmp("",
#include "entry_points.def"
"~") < 0, "");
// clang-format on

int tp_find_entry(const char* name) {
  // The first three bytes turn away nearly every name that a program looks up.
  if (name == NULL || (name[0] != 'e' && name[0] != 'g' && name[0] != 'O')) return -1;
  if (name[1] != 'g' && name[1] != 'l' && name[1] != 'S') return -1;
  if (name[2] != 'l' && name[2] != 'X' && name[2] != 'f' && name[2] != 'M') return -1;
  int low = 0, high = TP_ENTRY_COUNT;
  while (low < high) {
    const int middle = (low + high) / 2;
    const int order = tp_compare(name, tp_entry_names[middle]);
    if (order == 0) return middle;
    if (order < 0)
      high = middle;
    else
      low = middle + 1;
  }
  return -1;
}
