// Presenting: the bracket that every hook of a presenting call puts around the real call.
#pragma once

#include <stdbool.h>

#include "../engine_contract.h"

// Before the real call. True if tp_presented must be called after it; false for calls from inside a
// presenting call (drivers implement one through another) and where nothing is captured.
bool tp_presenting(struct TilepressPresent* present);

// After the real call.
void tp_presented(struct TilepressPresent* present, bool success);

// The program is about to destroy contexts of `display`, or a surface.
void tp_contexts_going(uint32_t api, void* display);
void tp_surface_going(void* display, uintptr_t surface);
