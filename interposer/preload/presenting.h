// Presenting: the bracket that every hook of a presenting call puts around the real call.
#pragma once

#include <stdbool.h>

#include "../engine_contract.h"

// The name of this road in, as in run.json: each library that links the hooks defines its own.
extern const char* const tp_via;

// By enum TilepressApi: how the engine finds the driver's functions where the driver is called without its
// public library; NULL where that library answers.
extern void* (*tp_driver_lookup[TILEPRESS_API_COUNT])(const char* name);

// Before the real call. True if tp_presented must be called after it; false for calls from inside a
// presenting call (drivers implement one through another) and where nothing is captured.
bool tp_presenting(struct TilepressPresent* present);

// After the real call.
void tp_presented(struct TilepressPresent* present, bool success);

// Before a watched GL call; `call` lacks via and look_up.
void tp_gl_called(struct TilepressGlCall* call);
// Where this thread's draw calls leave their mark; NULL where nothing is captured.
uint8_t* tp_gl_drawn_mark(void);

// The program is about to destroy a context of `display` (NULL: all of them), or a surface.
void tp_contexts_going(uint32_t api, void* display, void* context);
void tp_surface_going(void* display, uintptr_t surface);
