// Library symbols: lookups in the library that a given function belongs to, never through our own hooks.
#pragma once

#include "interposer/engine_contract.h"

namespace tilepress {

/// The loaded library that holds `present.real`. The library stays loaded for good. For a call that came from
/// a driver without its public library, it is the driver itself.
class LibrarySymbols {
 public:
  LibrarySymbols(const TilepressHost& host, const TilepressPresent& present);
  /// Searches the library and those it depends on, then the program's global scope. Returns null at the end.
  void* find(const char* name) const;
  /// Sets `function` to the result of find(). Returns false for null.
  template <typename Function>
  bool fill(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(find(name));
    return function != nullptr;
  }
  /// Searches a library that is loaded already, e.g. "libGLESv2.so.2".
  void* find_in_loaded(const char* library, const char* name) const;

 private:
  void* (*dlsym_)(void*, const char*);
  void* (*driver_look_up_)(const char*);
  void* handle_ = nullptr;
};

}  // namespace tilepress
