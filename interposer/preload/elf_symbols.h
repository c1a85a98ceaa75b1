// ELF symbols: finds definitions in loaded objects without dlsym, and so without changing dlerror.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Returns the function `name` of the object that holds `address`; NULL if the object defines none.
void* tp_symbol_in_object_of(const void* address, const char* name);

// Returns the first function `name` in load order, or NULL. Skips the shim itself and the object that holds
// `except` (may be NULL).
void* tp_symbol_anywhere(const char* name, const void* except);

// Returns true if `address` lies in the shim.
bool tp_is_ours(const void* address);

// Returns true if both addresses lie in one object.
bool tp_same_object(const void* a, const void* b);

// Returns the place in load order of the object that holds `address`: 0 for the program itself, -1 for no
// object.
int tp_load_position(const void* address);

// Copies the path under which the object that holds `address` was loaded. Returns false if the object has
// none (the program itself), or if the path does not fit.
bool tp_path_of_object(const void* address, char* path, size_t size);

// Returns a handle for dlsym of the object that holds `address`; NULL where the C library has none (musl).
void* tp_handle_of_object(const void* address);
