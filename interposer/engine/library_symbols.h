// Library symbols: lookups in the library that a given function belongs to, never through our own hooks.
#pragma once

#include <string>

#include "interposer/engine_contract.h"

namespace tilepress {

/// The loaded library that holds `function`. Stays loaded for good.
class LibrarySymbols {
 public:
  LibrarySymbols(const TilepressHost& host, void* function);
  /// From that library and those it depends on, else from the program's global scope, else null.
  void* find(const char* name) const;
  /// From a library that is loaded already, e.g. "libGLESv2.so.2".
  void* find_in_loaded(const char* library, const char* name) const;

 private:
  void* (*dlsym_)(void*, const char*);
  void* handle_ = nullptr;
};

}  // namespace tilepress
