// Target capture: frames that no presenting call ends: images of framebuffer objects (--targets all), and
// what a trigger ends (--trigger, OSMesa).
#pragma once

#include <vector>

#include "interposer/engine/frame_taker.h"
#include "interposer/engine/run_start.h"
#include "interposer/engine/source/present_source.h"
#include "interposer/engine/source_list.h"

namespace tilepress {

/// Thread-safe. The references must outlive the object.
class TargetCapture {
 public:
  TargetCapture(SurfaceRegistry& registry, SourceList& sources, RunStart& run, FrameTaker& taker,
                ShimLog& log)
      : registry_(registry), sources_(sources), run_(run), taker_(taker), log_(log) {}

  /// The program is about to make a watched GL call: takes the frames that the call ends.
  void gl_call(const TilepressGlCall& call);
  /// The program presents: takes the images that the thread has drawn to.
  void take_targets(const TilepressPresent& present, PresentSource& source);
  /// Images of `context` are gone: all, or those whose Attachment::image() equals `image` in the bits of
  /// `mask`.
  void forget(const void* context, uintptr_t image = 0, uintptr_t mask = 0);

 private:
  void end_frame(const TilepressGlCall& call, const TilepressPresent& present, PresentSource& source);
  void take_default_framebuffer(const TilepressGlCall& call, const TilepressPresent& present,
                                PresentSource& source);
  void leave_targets(const TilepressGlCall& call, const TilepressPresent& present, PresentSource& source);
  void take_images(const TilepressPresent& present, PresentSource& source,
                   const std::vector<Attachment>& images, FramebufferUse use, SurfaceRole role,
                   const char* cause);

  SurfaceRegistry& registry_;
  SourceList& sources_;
  RunStart& run_;
  FrameTaker& taker_;
  ShimLog& log_;
};

}  // namespace tilepress
