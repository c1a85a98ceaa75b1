// Engine loader: brings the capture engine into the process at the first presenting call.
#pragma once

#include "../engine_contract.h"

// Returns the engine and loads it first if need be. Returns NULL if TILEPRESS_OUT is not set or loading
// failed.
const struct TilepressEngine* tp_engine(void);

// Returns the engine if it is loaded, else NULL.
const struct TilepressEngine* tp_loaded_engine(void);
