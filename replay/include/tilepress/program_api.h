// Program API: guesses from a program's file whether it presents its frames through EGL or GLX.
#pragma once

#include <string>

#include "tilepress/trace_summary.h"

namespace tilepress {

struct ApiGuess {
  TraceApi api = TraceApi::kGlx;  ///< kEgl or kGlx
  std::string why;                ///< one line for -v
};

/// Looks for names of EGL and GLX in the program's file. A program whose toolkit decides at run time names
/// neither: then the guess is EGL in a Wayland session or without a display, and GLX with an X server.
ApiGuess guess_program_api(const std::string& program_path);

}  // namespace tilepress
