// Hook bank: what a lookup returns instead of the real function. A process may hold several libraries that
// define one entry point (Chromium: ANGLE and the system's libEGL). So a hook is bound to a real function,
// not to a name.
#pragma once

#include "entry_points.h"

// Returns a hook that forwards to `real`, always the same one. Returns `real` itself when all hooks of the
// entry are bound to other functions: the shim does not see its calls then.
void* tp_bind(enum tp_entry entry, void* real);

// Returns what a vendor library must answer for `name` where the driver answers `real` (may be NULL).
void* tp_answer_vendor(const char* name, void* real);
