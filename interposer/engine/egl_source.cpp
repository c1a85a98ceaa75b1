// EGL source: reads the surface of an eglSwapBuffers in a context of our own on the surface's config.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "interposer/engine/config_cache.h"
#include "interposer/engine/context_pool.h"
#include "interposer/engine/gl_readback.h"
#include "interposer/engine/in_context_readback.h"
#include "interposer/engine/library_symbols.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/present_source.h"

namespace tilepress {
namespace {

struct EglFunctions {
  decltype(&eglBindAPI) BindAPI = nullptr;
  decltype(&eglChooseConfig) ChooseConfig = nullptr;
  decltype(&eglCreateContext) CreateContext = nullptr;
  decltype(&eglDestroyContext) DestroyContext = nullptr;
  decltype(&eglGetConfigAttrib) GetConfigAttrib = nullptr;
  decltype(&eglGetCurrentContext) GetCurrentContext = nullptr;
  decltype(&eglGetCurrentDisplay) GetCurrentDisplay = nullptr;
  decltype(&eglGetCurrentSurface) GetCurrentSurface = nullptr;
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglQueryAPI) QueryAPI = nullptr;
  decltype(&eglQueryContext) QueryContext = nullptr;
  decltype(&eglQuerySurface) QuerySurface = nullptr;

  bool load(const LibrarySymbols& library) {
    const auto fill = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(library.find(name));
      return function != nullptr;
    };
    return fill(BindAPI, "eglBindAPI") && fill(ChooseConfig, "eglChooseConfig") &&
           fill(CreateContext, "eglCreateContext") && fill(DestroyContext, "eglDestroyContext") &&
           fill(GetConfigAttrib, "eglGetConfigAttrib") && fill(GetCurrentContext, "eglGetCurrentContext") &&
           fill(GetCurrentDisplay, "eglGetCurrentDisplay") &&
           fill(GetCurrentSurface, "eglGetCurrentSurface") && fill(GetProcAddress, "eglGetProcAddress") &&
           fill(MakeCurrent, "eglMakeCurrent") && fill(QueryAPI, "eglQueryAPI") &&
           fill(QueryContext, "eglQueryContext") && fill(QuerySurface, "eglQuerySurface");
  }
};

class EglSource final : public PresentSource {
 public:
  EglSource(const EglFunctions& egl, const GlFunctions& gl) : egl_(egl), gl_(gl) {}

  bool describe(const TilepressPresent& present, WindowKey& key, SurfaceShape& shape,
                std::string& reason) override {
    const auto surface = reinterpret_cast<EGLSurface>(present.surface);
    if (egl_.GetCurrentContext() == EGL_NO_CONTEXT) return fail(reason, "no context is current");
    if (egl_.GetCurrentDisplay() != present.display) return fail(reason, "another display is current");
    if (egl_.GetCurrentSurface(EGL_DRAW) != surface) return fail(reason, "the surface is not current");
    EGLint width = 0, height = 0;
    if (!egl_.QuerySurface(present.display, surface, EGL_WIDTH, &width) ||
        !egl_.QuerySurface(present.display, surface, EGL_HEIGHT, &height))
      return fail(reason, "eglQuerySurface failed");
    if (width < 1 || height < 1) return fail(reason, "the surface has no pixels");
    const auto config = config_of(present);
    if (!config) return fail(reason, "the surface has no config");
    key = {present.display, present.surface};
    shape = {static_cast<uint32_t>(width), static_cast<uint32_t>(height), config->format};
    return true;
  }

  bool read(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
            std::string& reason) override {
    const bool stay = in_program_context_only() || context_is_destroyed(present.display);
    switch (stay ? Attempt::kNotBound : read_privately(present, shape, frame, reason)) {
      case Attempt::kRead:
        return true;
      case Attempt::kContextLost:
        return false;
      default:
        break;
    }
    if (read_in_program_context(gl_, shape, is_double_buffered(present), frame)) return true;
    if (reason.empty()) reason = "the program's context cannot be read";
    return false;
  }

  void release(void* display) override {
    for (void* own : pool_.take_all(display)) egl_.DestroyContext(display, own);
    configs_.forget(display);
  }

  GlStrings strings() const override {
    const auto text = [&](GLenum name) {
      const GLubyte* value = gl_.GetString(name);
      return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "");
    };
    return {text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION)};
  }
  const char* api() const override { return "EGL"; }

 private:
  static bool fail(std::string& reason, const char* text) {
    reason = text;
    return false;
  }

  /// The program has destroyed its context, which lives on until something else is made current.
  bool context_is_destroyed(EGLDisplay display) const {
    EGLint id = 0;
    return !egl_.QueryContext(display, egl_.GetCurrentContext(), EGL_CONFIG_ID, &id);
  }

  enum class Attempt { kRead, kNotBound, kContextLost };

  Attempt read_privately(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
                         std::string& reason) {
    const auto surface = reinterpret_cast<EGLSurface>(present.surface);
    const EGLContext context = egl_.GetCurrentContext();
    const EGLSurface draw = egl_.GetCurrentSurface(EGL_DRAW), read = egl_.GetCurrentSurface(EGL_READ);
    const auto known = config_of(present);
    const EGLConfig config = known ? known->config : nullptr;
    const ContextPool::Key key{present.display, reinterpret_cast<uintptr_t>(config)};
    const uint64_t begin_ns = now_ns();
    EGLContext own = pool_.take(key);
    bool bound = own != EGL_NO_CONTEXT && egl_.MakeCurrent(present.display, surface, surface, own);
    if (!bound) {
      own = create(present.display, config);
      bound = own != EGL_NO_CONTEXT && egl_.MakeCurrent(present.display, surface, surface, own);
    }
    const uint64_t bound_ns = now_ns();
    GLenum error = 0;
    const bool taken = bound && read_back_buffer(gl_, shape, frame, error);
    const uint64_t taken_ns = now_ns();
    if (bound && !egl_.MakeCurrent(present.display, draw, read, context)) {
      reason = "the program's context could not be made current again";
      return Attempt::kContextLost;
    }
    frame.bind_ns = now_ns() - begin_ns - (taken_ns - bound_ns);
    if (own != EGL_NO_CONTEXT) pool_.give(key, own);
    if (!taken) reason = bound ? "glReadPixels failed" : "the private context cannot be made current";
    return taken ? Attempt::kRead : Attempt::kNotBound;
  }

  bool is_double_buffered(const TilepressPresent& present) const {
    EGLint buffer = EGL_BACK_BUFFER;
    egl_.QuerySurface(present.display, reinterpret_cast<EGLSurface>(present.surface), EGL_RENDER_BUFFER,
                      &buffer);
    return buffer == EGL_BACK_BUFFER;
  }

  std::optional<KnownConfig> config_of(const TilepressPresent& present) {
    EGLint id = 0;
    const auto surface = reinterpret_cast<EGLSurface>(present.surface);
    if (!egl_.QuerySurface(present.display, surface, EGL_CONFIG_ID, &id)) return std::nullopt;
    return configs_.find({present.display, id, 0}, [&]() -> std::optional<KnownConfig> {
      const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
      EGLConfig config = nullptr;
      EGLint count = 0;
      if (!egl_.ChooseConfig(present.display, wanted, &config, 1, &count) || count != 1) return std::nullopt;
      return KnownConfig{config, format_of(bits_of(present.display, config))};
    });
  }

  EGLint attribute(EGLDisplay display, EGLConfig config, EGLint name) const {
    EGLint value = 0;
    return egl_.GetConfigAttrib(display, config, name, &value) ? value : 0;
  }

  ChannelBits bits_of(EGLDisplay display, EGLConfig config) const {
    return {attribute(display, config, EGL_RED_SIZE), attribute(display, config, EGL_GREEN_SIZE),
            attribute(display, config, EGL_BLUE_SIZE), attribute(display, config, EGL_ALPHA_SIZE),
            attribute(display, config, EGL_COLOR_COMPONENT_TYPE_EXT) == EGL_COLOR_COMPONENT_TYPE_FLOAT_EXT};
  }

  EGLContext create(EGLDisplay display, EGLConfig config) const {
    const EGLint renderable = attribute(display, config, EGL_RENDERABLE_TYPE);
    const EGLenum program_api = egl_.QueryAPI();
    EGLContext context = EGL_NO_CONTEXT;
    const auto attempt = [&](EGLint bit, EGLenum api, EGLint version) {
      const EGLint attributes[] = {version != 0 ? EGL_CONTEXT_CLIENT_VERSION : EGL_NONE, version, EGL_NONE};
      if (context == EGL_NO_CONTEXT && (renderable & bit) != 0 && egl_.BindAPI(api))
        context = egl_.CreateContext(display, config, EGL_NO_CONTEXT, attributes);
    };
    attempt(EGL_OPENGL_ES3_BIT, EGL_OPENGL_ES_API, 3);
    attempt(EGL_OPENGL_ES2_BIT, EGL_OPENGL_ES_API, 2);
    attempt(EGL_OPENGL_BIT, EGL_OPENGL_API, 0);
    egl_.BindAPI(program_api);
    return context;
  }

  const EglFunctions egl_;
  const GlFunctions gl_;
  ContextPool pool_;
  ConfigCache configs_;
};

}  // namespace

std::unique_ptr<PresentSource> make_egl_source(const TilepressHost& host, const TilepressPresent& present) {
  const LibrarySymbols library(host, present);
  EglFunctions egl;
  GlFunctions gl;
  if (!egl.load(library)) return nullptr;
  const bool loaded = gl.load([&](const char* name) -> void* {
    if (present.look_up != nullptr) return present.look_up(name);
    if (void* found = reinterpret_cast<void*>(egl.GetProcAddress(name))) return found;
    for (const char* other : {"libGLESv2.so.2", "libGL.so.1", "libOpenGL.so.0"})
      if (void* found = library.find_in_loaded(other, name)) return found;
    return nullptr;
  });
  return loaded ? std::make_unique<EglSource>(egl, gl) : nullptr;
}

}  // namespace tilepress
