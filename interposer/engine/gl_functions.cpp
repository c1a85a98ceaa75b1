// GL functions: filled one by one.
#include "interposer/engine/gl_functions.h"

namespace tilepress {

bool GlFunctions::load(const Lookup& look_up) {
  const auto fill = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(look_up(name));
    return function != nullptr;
  };
  fill(ReadBuffer, "glReadBuffer");
  fill(BindFramebuffer, "glBindFramebuffer");
  fill(BindBuffer, "glBindBuffer");
  return fill(GetString, "glGetString") && fill(GetIntegerv, "glGetIntegerv") &&
         fill(GetError, "glGetError") && fill(PixelStorei, "glPixelStorei") &&
         fill(ReadPixels, "glReadPixels");
}

}  // namespace tilepress
