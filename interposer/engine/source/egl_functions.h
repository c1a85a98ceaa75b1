// EGL functions: the calls that the EGL source makes, looked up in the program's own library.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "interposer/engine/source/library_symbols.h"

// clang-format off
#define TILEPRESS_EGL_FUNCTIONS(X) \
  X(BindAPI) X(ChooseConfig) X(CreateContext) X(DestroyContext) X(GetConfigAttrib) X(GetCurrentContext) \
  X(GetCurrentDisplay) X(GetCurrentSurface) X(GetError) X(GetProcAddress) X(MakeCurrent) X(QueryAPI) \
  X(QueryContext) X(QueryString) X(QuerySurface)
// clang-format on

namespace tilepress {

struct EglFunctions {
#define TILEPRESS_MEMBER(name) decltype(&egl##name) name = nullptr;
  TILEPRESS_EGL_FUNCTIONS(TILEPRESS_MEMBER)
#undef TILEPRESS_MEMBER

  /// Returns false if a function is missing.
  bool load(const LibrarySymbols& library) {
    bool whole = true;
#define TILEPRESS_FILL(name) whole &= library.fill(name, "egl" #name);
    TILEPRESS_EGL_FUNCTIONS(TILEPRESS_FILL)
#undef TILEPRESS_FILL
    return whole;
  }
};

}  // namespace tilepress
