// Private session: reads a drawable in a context of our own, or in the program's where there is no other way.
#pragma once

#include <GL/gl.h>

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/late_reader.h"
#include "interposer/engine/readback/pixel_buffer_groups.h"
#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine_contract.h"
#include "tilepress/result.h"

namespace tilepress {

/// What is current on a thread.
struct Binding {
  void* display = nullptr;
  uintptr_t draw = 0, read = 0;  ///< EGLSurface or GLXDrawable
  void* context = nullptr;       ///< EGLContext or GLXContext; null = nothing is current
};

/// The calls in which EGL and GLX differ for a private session.
class ContextApi {
 public:
  virtual Binding current() const = 0;
  /// Returns true if the program's context and drawables can be made current again.
  virtual bool can_come_back(const TilepressPresent& present) const = 0;
  /// The buffer of `drawable` that the present shows: GL_BACK or GL_FRONT.
  virtual GLenum buffer_of(const Drawable& drawable) const = 0;

  virtual bool bind(const Binding& binding) const = 0;
  /// Makes `own`, which shares objects with the program's context, current on the program's thread.
  virtual bool bind_sharing(const Binding& program, void* own) const = 0;

  /// Each of the two returns null if there is no such context.
  virtual void* create_private(const Drawable& drawable, const Binding& program) const = 0;
  virtual void* create_sharing(const TilepressPresent& present, const Binding& program) = 0;
  /// Makes the twin of the private context `own`, which is current. Returns false if there is no twin.
  virtual bool create_twin(const Drawable& drawable, void* own, TwinContext& twin) const = 0;
  virtual void destroy(void* display, void* context) const = 0;

 protected:
  ~ContextApi() = default;
};

/// Contexts that are current on no thread. The pool destroys none: at the end of a process GL must not be
/// called.
class ContextPool {
 public:
  struct Key {
    const void* display;
    uintptr_t config;
    auto operator<=>(const Key&) const = default;
  };
  /// Returns a free context for `key`, or null. The caller owns the context until give().
  void* take(const Key& key) {
    std::lock_guard lock(mutex_);
    const auto taken = free_.extract(key);
    return taken ? taken.mapped() : nullptr;
  }
  void give(const Key& key, void* context) {
    std::lock_guard lock(mutex_);
    free_.emplace(key, context);
  }
  /// Takes out all free contexts of `display`.
  std::vector<void*> take_all(const void* display) {
    std::lock_guard lock(mutex_);
    std::vector<void*> taken;
    std::erase_if(free_, [&](const auto& entry) {
      if (entry.first.display == display) taken.push_back(entry.second);
      return entry.first.display == display;
    });
    return taken;
  }

 private:
  std::mutex mutex_;
  std::multimap<Key, void*> free_;
};

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
