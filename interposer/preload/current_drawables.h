// Current drawables: which GLX drawables each thread has current, for presents by a thread that has not.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// The calling thread has made these current; 0 = none.
void tp_drawables_current(uintptr_t draw, uintptr_t read);

// True if a thread other than the calling one has `drawable` current, or if nobody can know.
bool tp_is_current_elsewhere(uintptr_t drawable);
