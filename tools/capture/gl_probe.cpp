// GL probe: dlopen of libEGL in a forked child, which answers through a pipe.
#include "capture/gl_probe.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

namespace tilepress {
namespace {

template <typename F>
F find(void* library, const char* name) {
  return reinterpret_cast<F>(dlsym(library, name));
}

std::string text_of(const void* text) {
  return text != nullptr ? static_cast<const char*>(text) : "";
}

GlProbe probe_here() {
  GlProbe out;
  void* egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (egl == nullptr) {
    out.failure = "libEGL.so.1 cannot be loaded";
    return out;
  }
  const auto query = find<decltype(&eglQueryString)>(egl, "eglQueryString");
  const auto get_address = find<decltype(&eglGetProcAddress)>(egl, "eglGetProcAddress");
  out.egl_version = text_of(query(EGL_NO_DISPLAY, EGL_VERSION));
  out.glvnd = out.egl_version.find("glvnd") != std::string::npos;

  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get_address("eglGetPlatformDisplayEXT"));
  EGLDisplay display =
      get_display != nullptr ? get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr) : EGL_NO_DISPLAY;
  out.failure = "no surfaceless EGL display";
  if (display == EGL_NO_DISPLAY) return out;
  if (!find<decltype(&eglInitialize)>(egl, "eglInitialize")(display, nullptr, nullptr)) return out;
  const EGLint wishes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  out.failure = "no OpenGL ES 2 context";
  if (!find<decltype(&eglChooseConfig)>(egl, "eglChooseConfig")(display, wishes, &config, 1, &count) ||
      count == 0)
    return out;
  find<decltype(&eglBindAPI)>(egl, "eglBindAPI")(EGL_OPENGL_ES_API);
  const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  EGLContext context =
      find<decltype(&eglCreateContext)>(egl, "eglCreateContext")(display, config, EGL_NO_CONTEXT, version);
  const EGLint size[] = {EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE};
  EGLSurface surface =
      find<decltype(&eglCreatePbufferSurface)>(egl, "eglCreatePbufferSurface")(display, config, size);
  if (context == EGL_NO_CONTEXT ||
      !find<decltype(&eglMakeCurrent)>(egl, "eglMakeCurrent")(display, surface, surface, context))
    return out;
  const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(get_address("glGetString"));
  out.vendor = text_of(get_string(GL_VENDOR));
  out.renderer = text_of(get_string(GL_RENDERER));
  out.version = text_of(get_string(GL_VERSION));
  out.failure.clear();
  return out;
}

}  // namespace

GlProbe probe_gl() {
  GlProbe out;
  out.failure = "the probe could not be started";
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return out;
  const pid_t child = fork();
  if (child == 0) {
    // Drivers write their complaints to standard error.
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    const GlProbe found = probe_here();
    std::ostringstream text;
    text << found.glvnd << '\n'
         << found.egl_version << '\n'
         << found.vendor << '\n'
         << found.renderer << '\n'
         << found.version << '\n'
         << found.failure << '\n';
    const std::string answer = text.str();
    const bool sent = write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  std::string answer;
  char buffer[1024];
  for (ssize_t got = 0; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
    answer.append(buffer, static_cast<size_t>(got));
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (answer.empty()) {
    if (WIFSIGNALED(status)) out.failure = "the driver crashed, signal " + std::to_string(WTERMSIG(status));
    return out;
  }
  std::istringstream lines(answer);
  std::string flag;
  std::getline(lines, flag);
  out.glvnd = flag == "1";
  for (std::string* field : {&out.egl_version, &out.vendor, &out.renderer, &out.version, &out.failure})
    std::getline(lines, *field);
  return out;
}

}  // namespace tilepress
