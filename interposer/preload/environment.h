// Environment: reads variables without getenv. Shells and sandboxes define a getenv of their own.
#pragma once

// Returns the value of a variable; NULL if it is not set or empty.
const char* tp_environment(const char* name);
