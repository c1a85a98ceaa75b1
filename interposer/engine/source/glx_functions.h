// GLX functions: the calls that the GLX source makes, looked up in the program's own libraries.
#pragma once

#include <GL/glx.h>
#include <GL/glxext.h>

#include "interposer/engine/source/library_symbols.h"

// clang-format off
#define TILEPRESS_GLX_FUNCTIONS(X) \
  X(ChooseFBConfig) X(CreateNewContext) X(DestroyContext) X(GetCurrentContext) X(GetCurrentDisplay) \
  X(GetCurrentDrawable) X(GetCurrentReadDrawable) X(GetFBConfigAttrib) X(GetProcAddressARB) X(IsDirect) \
  X(MakeContextCurrent) X(QueryContext) X(QueryDrawable)
// clang-format on

namespace tilepress {

struct GlxFunctions {
  using CloseHook = int (*)(Display*, XExtCodes*);
#define TILEPRESS_MEMBER(name) decltype(&glX##name) name = nullptr;
  TILEPRESS_GLX_FUNCTIONS(TILEPRESS_MEMBER)
#undef TILEPRESS_MEMBER
  PFNGLXGETCONTEXTIDEXTPROC GetContextIDEXT = nullptr;  ///< may be null
  decltype(&XDefaultScreen) DefaultScreenOf = nullptr;
  decltype(&XFree) Free = nullptr;
  decltype(&XAddExtension) AddExtension = nullptr;
  CloseHook (*SetCloseDisplay)(Display*, int, CloseHook) = nullptr;

  /// Returns false if a function is missing that must be there.
  bool load(const LibrarySymbols& library) {
    bool whole = true;
#define TILEPRESS_FILL(name) whole &= library.fill(name, "glX" #name);
    TILEPRESS_GLX_FUNCTIONS(TILEPRESS_FILL)
#undef TILEPRESS_FILL
    library.fill(GetContextIDEXT, "glXGetContextIDEXT");
    return whole && library.fill(DefaultScreenOf, "XDefaultScreen") && library.fill(Free, "XFree") &&
           library.fill(AddExtension, "XAddExtension") && library.fill(SetCloseDisplay, "XESetCloseDisplay");
  }
};

}  // namespace tilepress
