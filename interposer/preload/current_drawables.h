// Current drawables: which GLX drawables each thread has current. A present from another thread needs this. A
// destroyed context lives on until its thread makes another one current; this is recorded too.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// Call after the calling thread has made these current; 0 = none.
void tp_made_current(uintptr_t draw, uintptr_t read, uintptr_t context);

// Call before the program destroys `context`, on whichever thread it is current.
void tp_context_destroyed(uintptr_t context);

// Returns true if the calling thread's current context is destroyed: a request for it is an X error.
bool tp_current_context_is_destroyed(void);

// Returns true if another thread has `drawable` current, or may have it because the rows are incomplete.
bool tp_is_current_elsewhere(uintptr_t drawable);
