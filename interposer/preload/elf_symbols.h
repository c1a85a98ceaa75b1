// ELF symbols: finding a definition in loaded objects without dlsym, hence without touching dlerror.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// The function `name` defined by the object that holds `address`; NULL if it defines none.
void* tp_symbol_in_object_of(const void* address, const char* name);

// The first definition of `name` in load order, leaving out the shim itself and the object that holds
// `except`.
void* tp_symbol_anywhere(const char* name, const void* except);

// True if `address` lies in the shim.
bool tp_is_ours(const void* address);

// True if both addresses lie in one object.
bool tp_same_object(const void* a, const void* b);

// Place in load order (0 = the program itself) of the object that holds `address`; -1 if none does.
int tp_load_position(const void* address);

// Copies the path of the object that holds `address`, as it was loaded. False if there is none (the program
// itself), or if it does not fit.
bool tp_path_of_object(const void* address, char* path, size_t size);

// The object that holds `address`, as a handle for dlsym; NULL where the C library does not show it (musl).
void* tp_handle_of_object(const void* address);
