// Engine loader: brings the capture engine into the process at the first presenting call.
#pragma once

#include "../engine_contract.h"

// The engine; NULL if there is nowhere to write to (TILEPRESS_OUT), or if it could not be loaded.
const struct TilepressEngine* tp_engine(void);

// The engine if it has been loaded already.
const struct TilepressEngine* tp_loaded_engine(void);
