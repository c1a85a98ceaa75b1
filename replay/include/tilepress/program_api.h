// Program API: through which window system interface a program will present its frames, guessed from its
// file.
#pragma once

#include <string>

#include "tilepress/trace_summary.h"

namespace tilepress {

struct ApiGuess {
  TraceApi api = TraceApi::kGlx;  ///< kEgl or kGlx
  bool certain = false;           ///< the program names functions of this one alone
  std::string why;                ///< one line for -v
};

/// Looks for names of EGL and GLX in the program's file. Toolkits decide at run time and leave no name in a
/// program: then a Wayland session or the want of any display speaks for EGL, an X server for GLX.
ApiGuess guess_program_api(const std::string& program_path);

}  // namespace tilepress
