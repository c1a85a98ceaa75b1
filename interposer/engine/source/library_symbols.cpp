// Library symbols: the handle comes from the function's address.
#include "interposer/engine/source/library_symbols.h"

#include <dlfcn.h>

namespace tilepress {

LibrarySymbols::LibrarySymbols(const TilepressHost& host, const TilepressPresent& present)
    : dlsym_(host.dlsym), driver_look_up_(present.look_up) {
  char path[4096];
  if (host.path_of_object(present.real, path, sizeof path))
    handle_ = dlopen(path, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

void* LibrarySymbols::find(const char* name) const {
  void* found = driver_look_up_ != nullptr ? driver_look_up_(name) : nullptr;
  if (found == nullptr && handle_ != nullptr) found = dlsym_(handle_, name);
  if (found == nullptr) found = dlsym_(RTLD_DEFAULT, name);
  dlerror();
  return found;
}

void* LibrarySymbols::find_in_loaded(const char* library, const char* name) const {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  void* found = handle != nullptr ? dlsym_(handle, name) : nullptr;
  dlerror();
  return found;
}

}  // namespace tilepress
