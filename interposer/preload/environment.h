// Environment: variables of the process, read without getenv, which shells and sandboxes define themselves.
#pragma once

// The value of a variable; NULL if it is not set or empty.
const char* tp_environment(const char* name);
