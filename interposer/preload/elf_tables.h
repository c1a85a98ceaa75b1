// ELF tables: looks a function up in the dynamic section of one loaded object.
#pragma once

#include <link.h>
#include <stdint.h>

// A loaded object: what its addresses are relative to, and its dynamic section in memory.
struct tp_object {
  uintptr_t base;
  const ElfW(Dyn) * dynamic;
};

// The function `name` that the object defines, in its default version if it has one; NULL if it defines none.
// Calls no function of another library.
void* tp_function_in(const struct tp_object* object, const char* name);

// The object's own name (DT_SONAME), or "".
const char* tp_own_name(const struct tp_object* object);
