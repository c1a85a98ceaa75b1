// Program API: searches an executable for the names of window system functions.
#include "tilepress/program_api.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <vector>

namespace tilepress {
namespace {

constexpr std::array<std::string_view, 4> kEglNames = {"eglSwapBuffers", "eglGetDisplay",
                                                       "eglGetPlatformDisplay", "libEGL.so"};
constexpr std::array<std::string_view, 4> kGlxNames = {"glXSwapBuffers", "glXCreateContext", "glXMakeCurrent",
                                                       "libGLX.so"};
constexpr size_t kPieceBytes = 1 << 20;
constexpr size_t kOverlapBytes = 32;  // no name is longer

bool holds_any(const std::vector<char>& piece, size_t length, const std::array<std::string_view, 4>& names) {
  const std::string_view text(piece.data(), length);
  return std::any_of(names.begin(), names.end(),
                     [text](std::string_view name) { return text.find(name) != std::string_view::npos; });
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

ApiGuess guess_program_api(const std::string& program_path) {
  std::ifstream file(program_path, std::ios::binary);
  std::vector<char> piece(kOverlapBytes + kPieceBytes);
  bool egl = false, glx = false;
  size_t kept = 0;
  while (file && !(egl && glx)) {
    file.read(piece.data() + kept, static_cast<std::streamsize>(kPieceBytes));
    const size_t length = kept + static_cast<size_t>(file.gcount());
    egl = egl || holds_any(piece, length, kEglNames);
    glx = glx || holds_any(piece, length, kGlxNames);
    kept = std::min(length, kOverlapBytes);
    std::copy_n(piece.begin() + static_cast<ptrdiff_t>(length - kept), kept, piece.begin());
  }
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
