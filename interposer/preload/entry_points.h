// Entry points: the names that the shim stands in front of, and what each does. The list is entry_points.def.
#pragma once

enum tp_entry {
#define TP_ENTRY(name, ...) TP_ENTRY_##name,
#include "entry_points.def"
  TP_ENTRY_COUNT
};

enum tp_entry_kind {
  TP_PRESENTS,       // ends a frame
  TP_MAKES_CURRENT,  // gives the thread another context
  TP_LOOKS_UP,       // returns functions by name
  TP_DESTROYS,       // ends the life of a context or surface
  TP_SERVES_OSMESA,  // matters where OSMesa draws; programs of other APIs call it too
};

enum { TP_ENTRY_NAME_SIZE = 28 };  // bytes of the longest name with its zero

// Hidden arrays: they can be read before the dynamic linker has relocated this library.
#pragma GCC visibility push(hidden)
extern const char tp_entry_names[TP_ENTRY_COUNT][TP_ENTRY_NAME_SIZE];
extern const unsigned char tp_entry_kinds[TP_ENTRY_COUNT];  // enum tp_entry_kind
#pragma GCC visibility pop

// Returns the entry point called `name` (may be NULL), or -1.
int tp_find_entry(const char* name);
