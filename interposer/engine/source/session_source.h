// Session source: what the sources of EGL and GLX have in common.
#pragma once

#include "interposer/engine/readback/private_session.h"
#include "interposer/engine/source/config_cache.h"
#include "interposer/engine/source/present_source.h"

namespace tilepress {

/// Reads through a private session, whose calls of EGL or GLX the derived class makes.
class SessionSource : public PresentSource, protected ContextApi {
 public:
  const GlFunctions& gl() const override { return gl_; }
  Result<void> read(const TilepressPresent& present, const Drawable& drawable,
                    CapturedFrame& frame) override {
    return session_.read(present, drawable, frame);
  }
  Result<void> read_in_place(const TilepressPresent& present, const Drawable& drawable, GLenum buffer,
                             CapturedFrame& frame) override {
    return session_.read_in_place(present, drawable, buffer, frame);
  }
  Result<void> beside(const TilepressPresent& present, const std::function<void()>& work) override {
    return session_.beside(present, work);
  }
  bool find_current(TilepressPresent& present, FramebufferUse use) override {
    if (context() == nullptr) return false;
    const Binding now = current();
    present.display = now.display;
    present.surface = use == FramebufferUse::kRead ? now.read : now.draw;
    return true;
  }

 protected:
  SessionSource(const GlFunctions& gl, const SourceSettings& settings)
      : gl_(gl), session_(*this, gl_, settings.reader, settings.in_context_only) {}

  const GlFunctions gl_;
  ConfigCache configs_;
  PrivateSession session_;
};

}  // namespace tilepress
