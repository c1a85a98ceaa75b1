// Present source: how one window-system API tells what is being presented, and lends its back buffer for
// reading.
#pragma once

#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/surface_registry.h"
#include "interposer/engine_contract.h"

namespace tilepress {

struct GlStrings {
  std::string vendor, renderer, version;
};

/// One per API and real library. All calls come from the presenting thread, before the real call; several
/// threads may be inside at once.
class PresentSource {
 public:
  virtual ~PresentSource() = default;
  /// The window and shape that `present` presents. False, with the reason, if the call presents nothing that
  /// the calling thread could read.
  virtual bool describe(const TilepressPresent& present, WindowKey& key, SurfaceShape& shape,
                        std::string& reason) = 0;
  /// Reads the back buffer in a private context and makes the program's context current again, or in the
  /// program's. `frame.way` says how, and afterwards how it was.
  virtual bool read(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
                    std::string& reason) = 0;
  /// Reads `buffer` (GL_BACK, GL_FRONT and the like) of what `present` presents, in the program's context.
  /// While it reads, that surface is the one that the context reads from; afterwards all is current as
  /// before.
  virtual bool read_in_place(const TilepressPresent& present, const SurfaceShape& shape, GLenum buffer,
                             CapturedFrame& frame, std::string& reason) = 0;
  /// Fills in what is current on the calling thread: display, and the surface that the context draws to or
  /// reads from. False if no context of this API is current.
  virtual bool find_current(TilepressPresent& present, FramebufferUse use) = 0;
  /// The context that is current on the calling thread.
  virtual const void* context() const = 0;
  /// Runs `work` in a private context that shares objects with the program's, and makes the program's current
  /// again. False, with the reason, if it did not run; not to be tried on a context that is lost then.
  virtual bool beside(const TilepressPresent& present, const std::function<void()>& work,
                      std::string& reason) = 0;
  virtual const GlFunctions& gl() const = 0;
  /// The API's error flag of this thread, taken out and put back, where GL calls stand between two that set
  /// it.
  virtual uint32_t take_error() { return 0; }
  virtual void put_back_error(uint32_t) {}
  /// Destroys the contexts kept for `display`, which the program is about to tear down. The API must match.
  virtual void release(void* display) = 0;
  /// The program is about to destroy a surface of `display`: pixel buffers that are not in use go.
  virtual void trim(void*) {}
  /// Of the program's own context, which is current.
  GlStrings strings() const {
    const auto text = [&](GLenum name) {
      const GLubyte* value = gl().GetString(name);
      return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "");
    };
    return {text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION)};
  }
  /// Whether Mesa draws on the processor in the program's context; false if none is current.
  bool draws_in_software() const {
    if (context() == nullptr) return false;
    const auto* renderer = reinterpret_cast<const char*>(gl().GetString(GL_RENDERER));
    if (renderer == nullptr) return false;
    for (const char* name : {"llvmpipe", "softpipe", "SWR", "Software Rasterizer"})
      if (strstr(renderer, name) != nullptr) return true;
    return false;
  }
  virtual const char* api() const = 0;

 protected:
  /// What came of a read in a private context.
  enum class Attempt { kRead, kNotBound, kContextLost };
  /// Reads in a private context, and where that cannot be in the program's: there first if `frame.way` says
  /// so, there alone if `stay`.
  template <typename Privately, typename InPlace>
  static bool read_either(bool stay, CapturedFrame& frame, std::string& reason, const Privately& privately,
                          const InPlace& in_place) {
    if (stay) return in_place();
    if (frame.way == ReadWay::kInContext) {
      if (in_place()) return true;
      frame.way = ReadWay::kSync;
      reason.clear();
    }
    const Attempt attempt = privately();
    return attempt == Attempt::kRead || (attempt == Attempt::kNotBound && in_place());
  }
  static bool fail(std::string& reason, const char* text) {
    reason = text;
    return false;
  }
};

/// Null if the library that holds `present.real` lacks a function the readback needs.
std::unique_ptr<PresentSource> make_egl_source(const TilepressHost& host, const TilepressPresent& present,
                                               LateReader& reader);
std::unique_ptr<PresentSource> make_glx_source(const TilepressHost& host, const TilepressPresent& present,
                                               LateReader& reader);
std::unique_ptr<PresentSource> make_osmesa_source(const TilepressHost& host, const TilepressPresent& present);

}  // namespace tilepress
