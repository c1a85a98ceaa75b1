// The real dlsym and dlvsym, which the shim's own exports stand in front of.
#pragma once

typedef void* (*tp_dlsym_function)(void* handle, const char* name);
typedef void* (*tp_dlvsym_function)(void* handle, const char* name, const char* version);

// Found in the C library itself; NULL only where the C library has none.
tp_dlsym_function tp_real_dlsym(void);
tp_dlvsym_function tp_real_dlvsym(void);
