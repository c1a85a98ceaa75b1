// ELF tables: looks a function up in the dynamic section of one loaded object.
#pragma once

#include <link.h>
#include <stdint.h>

// A loaded object: the base of its addresses, and its dynamic section in memory.
struct tp_object {
  uintptr_t base;
  const ElfW(Dyn) * dynamic;
};

// Returns the function `name` of the object, in its default version if there is one; NULL if the object
// defines none. Calls no function of another library.
void* tp_function_in(const struct tp_object* object, const char* name);

// Returns the object's own name (DT_SONAME), or "".
const char* tp_own_name(const struct tp_object* object);
