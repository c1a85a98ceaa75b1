// GL functions: filled one by one.
#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

bool GlFunctions::load(const Lookup& look_up) {
  const auto fill = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(look_up(name));
    return function != nullptr;
  };
  fill(GetStringi, "glGetStringi");
  fill(GetFloatv, "glGetFloatv");
  fill(PixelTransferi, "glPixelTransferi");
  fill(PixelTransferf, "glPixelTransferf");
  if (!fill(ClampColor, "glClampColor")) fill(ClampColor, "glClampColorARB");
  fill(MatrixMode, "glMatrixMode");
  fill(LoadMatrixf, "glLoadMatrixf");
  fill(ReadBuffer, "glReadBuffer");
  fill(ReadBufferNV, "glReadBufferNV");
  fill(IsEnabled, "glIsEnabled");
  fill(Enable, "glEnable");
  fill(Disable, "glDisable");
  fill(GenBuffers, "glGenBuffers");
  fill(DeleteBuffers, "glDeleteBuffers");
  fill(BufferData, "glBufferData");
  fill(MapBufferRange, "glMapBufferRange");
  fill(UnmapBuffer, "glUnmapBuffer");
  fill(FenceSync, "glFenceSync");
  fill(ClientWaitSync, "glClientWaitSync");
  fill(DeleteSync, "glDeleteSync");
  fill(Flush, "glFlush");
  fill(BindBuffer, "glBindBuffer");
  fill(BindFramebuffer, "glBindFramebuffer");
  fill(BindFramebufferEXT, "glBindFramebufferEXT");
  fill(BindFramebufferOES, "glBindFramebufferOES");
  fill(CheckFramebufferStatus, "glCheckFramebufferStatus");
  fill(GetFramebufferAttachmentParameteriv, "glGetFramebufferAttachmentParameteriv");
  fill(IsTexture, "glIsTexture");
  fill(BindTexture, "glBindTexture");
  fill(GetTexLevelParameteriv, "glGetTexLevelParameteriv");
  fill(IsRenderbuffer, "glIsRenderbuffer");
  fill(BindRenderbuffer, "glBindRenderbuffer");
  fill(GetRenderbufferParameteriv, "glGetRenderbufferParameteriv");
  fill(GetTextureLevelParameteriv, "glGetTextureLevelParameteriv");
  fill(GetNamedRenderbufferParameteriv, "glGetNamedRenderbufferParameteriv");
  fill(GenFramebuffers, "glGenFramebuffers");
  fill(DeleteFramebuffers, "glDeleteFramebuffers");
  fill(FramebufferRenderbuffer, "glFramebufferRenderbuffer");
  fill(FramebufferTexture2D, "glFramebufferTexture2D");
  fill(FramebufferTextureLayer, "glFramebufferTextureLayer");
  fill(GenRenderbuffers, "glGenRenderbuffers");
  fill(DeleteRenderbuffers, "glDeleteRenderbuffers");
  fill(RenderbufferStorage, "glRenderbufferStorage");
  fill(BlitFramebuffer, "glBlitFramebuffer");
  return fill(GetString, "glGetString") && fill(GetIntegerv, "glGetIntegerv") &&
         fill(GetError, "glGetError") && fill(PixelStorei, "glPixelStorei") &&
         fill(ReadPixels, "glReadPixels");
}

}  // namespace tilepress
