// Load list: the objects of the process in load order, as the dynamic linker shows them to debuggers. Reading
// the list calls no function of another library, takes no lock, and works before this library is relocated.
#pragma once

#include <link.h>

// Returns this library's own entry, or NULL if no list holds it. Read only the entries of objects that the
// program started with: others can disappear at any time.
const struct link_map* tp_own_entry(void);
