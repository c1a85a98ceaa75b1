// Library symbols: the handle comes from the function's address.
#include "interposer/engine/library_symbols.h"

#include <dlfcn.h>

namespace tilepress {

LibrarySymbols::LibrarySymbols(const TilepressHost& host, void* function) : dlsym_(host.dlsym) {
  Dl_info where;
  if (dladdr(function, &where) != 0)
    handle_ = dlopen(where.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

void* LibrarySymbols::find(const char* name) const {
  void* found = handle_ != nullptr ? dlsym_(handle_, name) : nullptr;
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
