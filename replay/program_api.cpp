// Program API: searches an executable for the names of window system functions.
#include "tilepress/program_api.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>

namespace tilepress {
namespace {

using Names = std::string_view[4];
constexpr Names kEglNames = {"eglSwapBuffers", "eglGetDisplay", "eglGetPlatformDisplay", "libEGL.so"};
constexpr Names kGlxNames = {"glXSwapBuffers", "glXCreateContext", "glXMakeCurrent", "libGLX.so"};

bool holds_any(const std::string& text, const Names& names) {
  return std::ranges::any_of(names, [&](const auto& name) { return text.find(name) != std::string::npos; });
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

ApiGuess guess_program_api(const std::string& program_path) {
  std::ifstream file(program_path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const bool egl = holds_any(text, kEglNames), glx = holds_any(text, kGlxNames);
  if (egl != glx)
    return {egl ? TraceApi::kEgl : TraceApi::kGlx, egl ? "the program names EGL functions and no GLX ones"
                                                       : "the program names GLX functions and no EGL ones"};
  const std::string both =
      egl ? "the program names functions of EGL and GLX" : "the program names neither EGL nor GLX";
  if (is_set("WAYLAND_DISPLAY")) return {TraceApi::kEgl, both + "; WAYLAND_DISPLAY is set"};
  if (!is_set("DISPLAY")) return {TraceApi::kEgl, both + "; there is no DISPLAY"};
  return {TraceApi::kGlx, both + "; DISPLAY is set"};
}

}  // namespace tilepress
