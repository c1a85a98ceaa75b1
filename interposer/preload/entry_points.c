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

int tp_find_entry(const char* name) {
  // The first byte turns away nearly every name that a program looks up.
  if (name == NULL || (name[0] != 'e' && name[0] != 'g' && name[0] != 'O')) return -1;
  for (int entry = 0; entry < TP_ENTRY_COUNT; ++entry)
    if (tp_compare(name, tp_entry_names[entry]) == 0) return entry;
  return -1;
}
