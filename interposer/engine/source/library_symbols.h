// Library symbols: lookups in the library that a given function belongs to, never through our own hooks.
#pragma once

#include <string>

#include "interposer/engine_contract.h"

namespace tilepress {

/// The loaded library that holds `present.real`, which stays loaded for good; or, where the present came from
/// a driver without its public library, the driver itself.
class LibrarySymbols {
 public:
  LibrarySymbols(const TilepressHost& host, const TilepressPresent& present);
  /// From there and the libraries it depends on, else from the program's global scope, else null.
  void* find(const char* name) const;
  /// From a library that is loaded already, e.g. "libGLESv2.so.2".
  void* find_in_loaded(const char* library, const char* name) const;

 private:
  void* (*dlsym_)(void*, const char*);
  void* (*driver_look_up_)(const char*);
  void* handle_ = nullptr;
};

}  // namespace tilepress
