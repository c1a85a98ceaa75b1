// Current drawables: which GLX drawables each thread has current, for presents by a thread that has not; and
// whether a thread's context is destroyed, which lives on until another is made current.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// The calling thread has made these current; 0 = none.
void tp_made_current(uintptr_t draw, uintptr_t read, uintptr_t context);

// The program is about to destroy `context`, on whichever thread it is current.
void tp_context_destroyed(uintptr_t context);

// True if the context that the calling thread has current on a drawable is destroyed: asking the X server for
// it would be an error.
bool tp_current_context_is_destroyed(void);

// True if a thread other than the calling one has `drawable` current, or if nobody can know.
bool tp_is_current_elsewhere(uintptr_t drawable);
