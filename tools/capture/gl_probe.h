// GL probe: vendor, renderer and versions of a headless EGL context on this machine.
#pragma once

#include <string>

namespace tilepress {

struct GlProbe {
  bool glvnd = false;       ///< libEGL is libglvnd's dispatcher
  std::string egl_version;  ///< of the dispatcher or the library; empty if libEGL.so.1 cannot be loaded
  /// Of an OpenGL ES 2 context on a surfaceless display; empty if there is none.
  std::string vendor, renderer, version;
  std::string failure;  ///< the step that failed; empty if none did
};

/// Probes in a child process, because some drivers crash.
GlProbe probe_gl();

}  // namespace tilepress
