// Shim environment: the variables that load the shim into a program.
#pragma once

#include <map>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// How the shim gets into a program (--via).
enum class ShimRoad {
  kAuto,     ///< preload; also glvnd where the machine has one EGL and one GLX vendor library
  kPreload,  ///< LD_PRELOAD
  kGlvnd,    ///< libglvnd's vendor libraries; reaches plugins opened with RTLD_DEEPBIND
};

/// Adds to `environment` the variables that load the shim into a program. Paths of this process's own
/// variables stay behind those of the shim. `preload_library` is the path of libtilepress-preload.so, without
/// colons and spaces, as LD_PRELOAD requires. The vendor libraries are in the same folder or in its folder
/// tilepress/. Fails where this machine lacks what `road` requires.
Result<void> add_shim_environment(std::map<std::string, std::string>& environment, ShimRoad road,
                                  const std::string& preload_library);

}  // namespace tilepress
