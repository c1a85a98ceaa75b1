// Via: the name of this road in, as in run.json.
#include "presenting.h"

const char* const tp_via = "preload";
