// Load list: the objects of the process in load order, as the dynamic linker shows them to debuggers. Reading
// the list calls no function of another library, works before this library is relocated, and takes no lock.
#pragma once

#include <link.h>

// This library's own entry; NULL if no list that holds it can be found. Only the entries of objects that the
// program started with may be read: others can go at any time.
const struct link_map* tp_own_entry(void);
