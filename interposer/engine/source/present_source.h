// Present source: how one window-system API describes what is presented and reads it.
#pragma once

#include <functional>
#include <memory>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine_contract.h"
#include "tilepress/result.h"

namespace tilepress {

/// One per API and real library. The presenting thread makes all calls, before the real call. Several threads
/// may be inside at once.
class PresentSource {
 public:
  virtual ~PresentSource() = default;
  virtual const char* api() const = 0;
  virtual const GlFunctions& gl() const = 0;

  /// Fails if the calling thread cannot read what `present` presents.
  virtual Result<Drawable> describe(const TilepressPresent& present) = 0;
  /// Reads what `present` shows. `frame.way` holds the way to try first, and afterwards the way taken. The
  /// program's context is current again when this returns.
  virtual Result<void> read(const TilepressPresent& present, const Drawable& drawable,
                            CapturedFrame& frame) = 0;
  /// Reads `buffer` (GL_BACK, GL_FRONT, …) of the drawable in the program's context.
  virtual Result<void> read_in_place(const TilepressPresent& present, const Drawable& drawable, GLenum buffer,
                                     CapturedFrame& frame) = 0;
  /// Runs `work` in a private context that shares objects with the program's, and makes the program's context
  /// current again.
  virtual Result<void> beside(const TilepressPresent& present, const std::function<void()>& work) = 0;

  /// Fills in what is current on the calling thread: the display, and the surface that the context draws to
  /// or reads from. Returns false if no context of this API is current.
  virtual bool find_current(TilepressPresent& present, FramebufferUse use) = 0;
  /// The context that is current on the calling thread, or null.
  virtual const void* context() const = 0;

  /// Takes the API's error flag of this thread, and puts it back. Needed between two calls of the program
  /// where none of them sets the flag.
  virtual uint32_t take_error() { return 0; }
  virtual void put_back_error(uint32_t) {}

  /// The program is about to tear down `display`: destroys the contexts kept for it.
  virtual void release(void* display) = 0;
  /// The program is about to destroy a surface of `display`: frees pixel buffers that are not in use.
  virtual void trim(void*) {}

  /// A string of the program's context, which must be current; "" if it has none.
  const char* string(GLenum name) const;
  /// Returns true if Mesa draws on the processor in the program's context.
  bool draws_in_software() const;
};

/// What every source is made with. `host` and `reader` must outlive the source.
struct SourceSettings {
  const TilepressHost& host;
  LateReader& reader;
  bool in_context_only;  ///< --readback in-context: no private context
};

/// Each returns null if the library that holds `present.real` lacks a function that the readback needs.
std::unique_ptr<PresentSource> make_egl_source(const SourceSettings& settings,
                                               const TilepressPresent& present);
std::unique_ptr<PresentSource> make_glx_source(const SourceSettings& settings,
                                               const TilepressPresent& present);
std::unique_ptr<PresentSource> make_osmesa_source(const SourceSettings& settings,
                                                  const TilepressPresent& present);

}  // namespace tilepress
