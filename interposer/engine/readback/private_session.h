// Private session: reads a drawable in a context of our own, or in the program's where there is no other way.
#pragma once

#include <functional>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/context_api.h"
#include "interposer/engine/readback/context_pool.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/readback/pixel_buffer_groups.h"
#include "tilepress/result.h"

namespace tilepress {

/// The private contexts of one source, and how they are made current and left. Thread-safe. Errors have the
/// kind kUnsupported if the frame cannot be read this way, and kSystem if the program's context could not be
/// made current again.
class PrivateSession {
 public:
  /// `in_context_only`: makes no private context. All three references must outlive the session.
  PrivateSession(ContextApi& api, const GlFunctions& gl, LateReader& reader, bool in_context_only)
      : api_(api), gl_(gl), reader_(reader), in_context_only_(in_context_only) {}

  /// Reads the buffer that `present` shows. Starts in the program's context if `frame.way` is kInContext,
  /// else in a private context, and falls back to the other. Updates `frame.way` to what was done.
  Result<void> read(const TilepressPresent& present, const Drawable& drawable, CapturedFrame& frame);
  /// Reads `buffer` (GL_BACK, GL_FRONT, …) of the drawable in the program's context.
  Result<void> read_in_place(const TilepressPresent& present, const Drawable& drawable, GLenum buffer,
                             CapturedFrame& frame);
  /// Runs `work` in a private context that shares objects with the program's.
  Result<void> beside(const TilepressPresent& present, const std::function<void()>& work);

  /// The program is about to tear down `display`: destroys the contexts kept for it.
  void release(void* display) { leave(display, true); }
  /// `display` is gone, and our contexts with it.
  void forget(void* display) { leave(display, false); }
  /// Deletes the pixel buffers of `display` that are not in use, soon.
  void trim(const void* display) { trim_later(groups_.of_display(display), reader_); }

 private:
  Result<void> read_swapped(const Binding& program, const TilepressPresent& present, const Drawable& drawable,
                            GLenum buffer, CapturedFrame& frame);
  Result<void> read_privately(Binding program, const Drawable& drawable, CapturedFrame& frame);
  void leave(void* display, bool destroy);

  ContextApi& api_;
  const GlFunctions& gl_;
  LateReader& reader_;
  const bool in_context_only_;
  ContextPool pool_;          ///< by config
  ContextPool sharing_;       ///< by the program's context
  PixelBufferGroups groups_;  ///< of the contexts in pool_
};

}  // namespace tilepress
