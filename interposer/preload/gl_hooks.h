// GL hooks: what a lookup of a watched GL function returns. Without --trigger and --targets: the real
// function.
#pragma once

#include <stdbool.h>

#include "gl_slots.h"

// Returns the number of `name` (may be NULL) in gl_names.def, or -1.
int tp_find_gl(const char* name);

// Returns false if a lookup of the name with this number returns the real function in any case.
bool tp_gl_concerns(int name);

// Returns what a lookup must answer for the name with this number where the real answer is `real` (may be
// NULL): a stub in front of `real`, or `real` itself where the call is not watched or all stubs are in use.
// `always`: the call is watched without an option (OSMesa's triggers).
void* tp_gl_answer(int name, void* real, bool always);
