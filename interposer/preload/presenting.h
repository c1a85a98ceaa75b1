// Presenting: the calls of the engine that hooks put around the real calls.
#pragma once

#include <stdbool.h>

#include "../engine_contract.h"

// Called by a vendor library: from now on calls of `api` come through libglvnd, and `look_up` returns the
// driver's functions, because no public library answers for the driver there. Without it the road is
// "preload".
void tp_come_through_glvnd(enum TilepressApi api, void* (*look_up)(const char* name));

// Call before the real call. Returns true if tp_presented must follow the real call. Returns false inside
// another presenting call (drivers implement one through another) and where nothing is captured.
bool tp_presenting(struct TilepressPresent* present);

// Call after the real call. `success`: the frame was presented.
void tp_presented(struct TilepressPresent* present, bool success);

// Call before a watched GL call. Fills in the context_destroyed, road and look_up of `call`.
void tp_gl_called(struct TilepressGlCall* call);
// Returns where this thread's draw calls leave their mark; NULL where nothing is captured.
uint8_t* tp_gl_drawn_mark(void);

// Call before the program destroys a context of `display` (`context` NULL: all of them), or a surface.
void tp_contexts_going(uint32_t api, void* display, void* context);
void tp_surface_going(void* display, uintptr_t surface);
