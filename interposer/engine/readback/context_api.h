// Context API: the calls in which EGL and GLX differ for a private session: query, bind, create.
#pragma once

#include <GL/gl.h>

#include <cstdint>

#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/source/drawable.h"
#include "interposer/engine_contract.h"

namespace tilepress {

/// What is current on a thread.
struct Binding {
  void* display = nullptr;
  uintptr_t draw = 0, read = 0;  ///< EGLSurface or GLXDrawable
  void* context = nullptr;       ///< EGLContext or GLXContext; null = nothing is current
};

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

}  // namespace tilepress
