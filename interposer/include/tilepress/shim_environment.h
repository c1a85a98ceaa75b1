// Shim environment: the variables that bring the shim into a program, by either road.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "tilepress/result.h"

namespace tilepress {

/// How the shim gets into a program (--via).
enum class ShimRoad {
  kAuto,     ///< preload, and glvnd too where this machine has one EGL and one GLX vendor library to pass on
  kPreload,  ///< LD_PRELOAD
  kGlvnd,    ///< libglvnd's vendor libraries; reaches plugins opened with RTLD_DEEPBIND
};

std::optional<ShimRoad> parse_shim_road(std::string_view text);

/// Adds to `environment` what makes the shim meet the presenting calls of a program started with it, on top
/// of this process's own variables. `preload_library` is the path of libtilepress-preload.so as it may stand
/// in LD_PRELOAD (no colon, no space); the vendor libraries are looked for beside it and in the folder
/// tilepress/ beside it. Fails where this machine lacks what `road` requires.
Result<void> add_shim_environment(std::map<std::string, std::string>& environment, ShimRoad road,
                          const std::string& preload_library);

}  // namespace tilepress
