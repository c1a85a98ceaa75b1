// Replay road: which retracer replays a trace, and on which window system.
#pragma once

#include <string>
#include <vector>

#include "tilepress/trace_replay.h"
#include "tilepress/trace_summary.h"

namespace tilepress {

struct ReplayRoad {
  std::string retracer;         ///< "eglretrace" or "glretrace"
  ReplayDisplay display;        ///< never kAuto
  std::string waffle_platform;  ///< for WAFFLE_PLATFORM; empty for glretrace, which does not use waffle
  std::string why;              ///< for -v

  std::string name() const;  ///< "eglretrace, surfaceless EGL"
};

/// Returns the roads worth trying, the best first. A forced choice leaves one. Error: kUnsupported if the
/// trace cannot be replayed here, kBadValue if the choices contradict each other.
Result<std::vector<ReplayRoad>> replay_roads(TraceApi api, RetracerChoice retracer, ReplayDisplay display);

}  // namespace tilepress
