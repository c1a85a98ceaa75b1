// Replay road: eglretrace without a display comes first, because it replays EGL and GLX traces alike.
#include "replay_road.h"

namespace tilepress {
namespace {

ReplayRoad egl_road(ReplayDisplay display, std::string why) {
  return {"eglretrace", display, display == ReplayDisplay::kSurfaceless ? "surfaceless_egl" : "x11_egl",
          std::move(why)};
}

std::vector<ReplayRoad> ranked_roads(TraceApi api, RetracerChoice retracer, ReplayDisplay display) {
  if (retracer == RetracerChoice::kGlx)
    return {{"glretrace", display == ReplayDisplay::kAuto ? ReplayDisplay::kXvfb : display, "", "asked for"}};
  if (display == ReplayDisplay::kXvfb || display == ReplayDisplay::kX11) {
    if (retracer == RetracerChoice::kAuto && api != TraceApi::kEgl)
      return {{"glretrace", display, "", std::string(name_of(api)) + " trace with an X server asked for"}};
    return {egl_road(display, "an X server was asked for")};
  }
  std::vector<ReplayRoad> roads = {
      egl_road(ReplayDisplay::kSurfaceless, "EGL without a display replays EGL and GLX calls alike")};
  if (display == ReplayDisplay::kSurfaceless) return roads;
  if (api == TraceApi::kEgl || retracer == RetracerChoice::kEgl)
    roads.push_back(egl_road(ReplayDisplay::kXvfb, "nothing was captured without a display"));
  else
    roads.push_back({"glretrace", ReplayDisplay::kXvfb, "", "nothing was captured without a display"});
  return roads;
}

}  // namespace

std::string ReplayRoad::name() const {
  switch (display) {
    case ReplayDisplay::kSurfaceless:
      return retracer + ", surfaceless EGL";
    case ReplayDisplay::kXvfb:
      return retracer + ", private Xvfb";
    default:
      return retracer + ", DISPLAY";
  }
}

Result<std::vector<ReplayRoad>> replay_roads(TraceApi api, RetracerChoice retracer, ReplayDisplay display) {
  if (api == TraceApi::kDirect3d)
    return Error{ErrorKind::kUnsupported, "holds Direct3D calls, which no retracer of this system replays"};
  if (retracer == RetracerChoice::kGlx && display == ReplayDisplay::kSurfaceless)
    return Error{ErrorKind::kBadValue,
                 "glretrace needs an X server: --api glx does not go with --display surfaceless"};
  return ranked_roads(api, retracer, display);
}

}  // namespace tilepress
