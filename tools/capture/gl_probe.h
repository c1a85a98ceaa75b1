// GL probe: what a headless EGL context on this machine is made of.
#pragma once

#include <string>

namespace tilepress {

struct GlProbe {
  bool glvnd = false;       ///< libEGL is libglvnd's dispatcher
  std::string egl_version;  ///< of the dispatcher or the library; empty if libEGL.so.1 cannot be loaded
  std::string vendor, renderer,
      version;          ///< of an OpenGL ES 2 context on a surfaceless display; empty if there is none
  std::string failure;  ///< the step that failed; empty if none did
};

/// Asks in a process of its own, because drivers have been seen to crash when they are asked.
GlProbe probe_gl();

}  // namespace tilepress
