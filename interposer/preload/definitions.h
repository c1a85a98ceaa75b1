// Definitions: the real functions that calls would reach without the shim.
#pragma once

// Returns the definition of `name` that a call of our export from the code at `caller` would reach without
// the shim: the next in load order, or one of the caller's own libraries, or `known` (may be NULL), or any.
// Returns NULL if no library defines the name. The library stays loaded. Looks the name up each time.
void* tp_definition_after_ours(const char* name, void* caller, void* known);

// Returns `found`, unless the code at `caller` belongs to the library of `found`. That library implements its
// function by calling the same name in a library beneath. Then returns the definition beneath, or NULL.
void* tp_beneath_caller(const char* name, void* found, void* caller);

// Keeps the library of `function` loaded, also after the program closes it. `function` may be called later.
void tp_pin_library_of(void* function);
