// EGL source: describes and reads the surface of an eglSwapBuffers.
#include <algorithm>
#include <cstring>
#include <vector>

#include "interposer/engine/readback/channel_bits.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/egl_functions.h"
#include "interposer/engine/source/session_source.h"

namespace tilepress {
namespace {

EGLSurface surface_of(const TilepressPresent& present) {
  return reinterpret_cast<EGLSurface>(present.surface);
}

bool holds(const char* all, const char* name) {
  return all != nullptr && strstr(all, name) != nullptr;
}

class EglSource final : public SessionSource {
 public:
  EglSource(const EglFunctions& egl, const GlFunctions& gl, const SourceSettings& settings)
      : SessionSource(gl, settings), egl_(egl) {}

  const char* api() const override { return "EGL"; }

  Result<Drawable> describe(const TilepressPresent& present) override {
    const EGLSurface surface = surface_of(present);
    if (egl_.GetCurrentContext() == EGL_NO_CONTEXT) return unreadable("no context is current");
    if (egl_.GetCurrentDisplay() != present.display) return unreadable("another display is current");
    if (egl_.GetCurrentSurface(EGL_DRAW) != surface && egl_.GetCurrentSurface(EGL_READ) != surface)
      return unreadable("the surface is not current");
    EGLint width = 0, height = 0;
    if (!egl_.QuerySurface(present.display, surface, EGL_WIDTH, &width) ||
        !egl_.QuerySurface(present.display, surface, EGL_HEIGHT, &height))
      return unreadable("eglQuerySurface failed");
    if (width < 1 || height < 1) return unreadable("the surface has no pixels");
    const std::optional<KnownConfig> config = config_of(present);
    if (!config) return unreadable("the surface has no config");
    return Drawable{{present.display, present.surface},
                    {static_cast<uint32_t>(width), static_cast<uint32_t>(height), config->format,
                     is_srgb(present), !is_pbuffer(present)},
                    config->config,
                    true,
                    config->multisampled};
  }

  const void* context() const override { return egl_.GetCurrentContext(); }

  uint32_t take_error() override { return static_cast<uint32_t>(egl_.GetError()); }

  // Repeats what raises the error. No harmless call raises the errors that are missing here: the program's
  // next call finds none of them.
  void put_back_error(uint32_t error) override {
    const EGLDisplay display = egl_.GetCurrentDisplay();
    EGLint value = 0;
    switch (error) {
      case EGL_BAD_DISPLAY:
        egl_.QuerySurface(EGL_NO_DISPLAY, EGL_NO_SURFACE, EGL_WIDTH, &value);
        break;
      case EGL_BAD_SURFACE:
        egl_.QuerySurface(display, EGL_NO_SURFACE, EGL_WIDTH, &value);
        break;
      case EGL_BAD_CONTEXT:
        egl_.QueryContext(display, EGL_NO_CONTEXT, EGL_CONFIG_ID, &value);
        break;
      case EGL_BAD_ATTRIBUTE:
        egl_.QueryContext(display, egl_.GetCurrentContext(), EGL_BAD_ATTRIBUTE, &value);
        break;
      case EGL_BAD_CONFIG:
        egl_.GetConfigAttrib(display, nullptr, EGL_RED_SIZE, &value);
        break;
      case EGL_BAD_PARAMETER:
        egl_.BindAPI(0);
        break;
      default:
        egl_.GetError();
    }
  }

  void release(void* display) override {
    session_.release(display);
    configs_.forget(display);
  }
  void trim(void* display) override { session_.trim(display); }

 private:
  Binding current() const override {
    return {egl_.GetCurrentDisplay(), reinterpret_cast<uintptr_t>(egl_.GetCurrentSurface(EGL_DRAW)),
            reinterpret_cast<uintptr_t>(egl_.GetCurrentSurface(EGL_READ)), egl_.GetCurrentContext()};
  }

  // A context or surface that the program has destroyed lives on until something else is current. The handle
  // of such a surface is unknown, or Mesa answers no query about it.
  bool can_come_back(const TilepressPresent&) const override {
    const EGLDisplay display = egl_.GetCurrentDisplay();
    const EGLSurface draw = egl_.GetCurrentSurface(EGL_DRAW), read = egl_.GetCurrentSurface(EGL_READ);
    const auto is_known = [&](EGLSurface surface) {
      EGLint id = 0;
      return surface != EGL_NO_SURFACE && egl_.QuerySurface(display, surface, EGL_CONFIG_ID, &id);
    };
    EGLint id = 0;
    if (!egl_.QueryContext(display, egl_.GetCurrentContext(), EGL_CONFIG_ID, &id)) return false;
    if (draw == EGL_NO_SURFACE && read == EGL_NO_SURFACE) return true;
    return is_known(draw) && is_known(read);
  }

  GLenum buffer_of(const Drawable& drawable) const override {
    EGLint buffer = EGL_BACK_BUFFER;
    egl_.QuerySurface(const_cast<void*>(drawable.key.display),
                      reinterpret_cast<EGLSurface>(drawable.key.surface), EGL_RENDER_BUFFER, &buffer);
    return buffer == EGL_BACK_BUFFER || version_of(gl_).embedded ? GL_BACK : GL_FRONT;
  }

  bool bind(const Binding& to) const override {
    return egl_.MakeCurrent(to.display, reinterpret_cast<EGLSurface>(to.draw),
                            reinterpret_cast<EGLSurface>(to.read), to.context) != EGL_FALSE;
  }

  bool bind_sharing(const Binding& program, void* own) const override {
    return bind({program.display, 0, 0, own}) || bind({program.display, program.draw, program.read, own});
  }

  void* create_private(const Drawable& drawable, const Binding& program) const override {
    const EGLDisplay display = program.display;
    const EGLint renderable = attribute(display, drawable.config, EGL_RENDERABLE_TYPE);
    const EGLenum program_api = egl_.QueryAPI();
    EGLContext context = EGL_NO_CONTEXT;
    const auto attempt = [&](EGLint bit, EGLenum api, EGLint version) {
      const EGLint attributes[] = {version != 0 ? EGL_CONTEXT_CLIENT_VERSION : EGL_NONE, version, EGL_NONE};
      if (context == EGL_NO_CONTEXT && (renderable & bit) != 0 && egl_.BindAPI(api))
        context = egl_.CreateContext(display, drawable.config, EGL_NO_CONTEXT, attributes);
    };
    attempt(EGL_OPENGL_ES3_BIT, EGL_OPENGL_ES_API, 3);
    attempt(EGL_OPENGL_ES2_BIT, EGL_OPENGL_ES_API, 2);
    attempt(EGL_OPENGL_BIT, EGL_OPENGL_API, 0);
    egl_.BindAPI(program_api);
    return context;
  }

  // Contexts share only with the same API, config and reset notification strategy, which has no query.
  void* create_sharing(const TilepressPresent&, const Binding& program) override {
    const EGLDisplay display = program.display;
    EGLint id = 0, count = 0, type = EGL_OPENGL_ES_API, version = 2;
    EGLConfig config = nullptr;
    egl_.QueryContext(display, program.context, EGL_CONFIG_ID, &id);
    egl_.QueryContext(display, program.context, EGL_CONTEXT_CLIENT_TYPE, &type);
    egl_.QueryContext(display, program.context, EGL_CONTEXT_CLIENT_VERSION, &version);
    const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
    if (id != 0 && (!egl_.ChooseConfig(display, wanted, &config, 1, &count) || count != 1))
      return EGL_NO_CONTEXT;
    const bool embedded = type == EGL_OPENGL_ES_API;
    const EGLenum program_api = egl_.QueryAPI();
    if (!egl_.BindAPI(static_cast<EGLenum>(type))) return EGL_NO_CONTEXT;
    EGLContext context = EGL_NO_CONTEXT;
    for (const EGLint major : {3, std::max(version, 2)})
      for (const EGLint strategy : {0, EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                    EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT})
        for (const EGLint profile : {0, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT}) {
          if (context != EGL_NO_CONTEXT || (embedded && profile != 0)) continue;
          std::vector<EGLint> wish;
          if (embedded || profile != 0) wish = {EGL_CONTEXT_CLIENT_VERSION, major};
          if (profile != 0)
            wish.insert(wish.end(), {EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK, profile});
          if (strategy != 0) wish.insert(wish.end(), {strategy, EGL_LOSE_CONTEXT_ON_RESET});
          wish.push_back(EGL_NONE);
          context = egl_.CreateContext(display, config, program.context, wish.data());
        }
    egl_.BindAPI(program_api);
    return context;
  }

  bool create_twin(const Drawable& drawable, void* own, TwinContext& twin) const override {
    const EGLDisplay display = egl_.GetCurrentDisplay();
    if (!holds(egl_.QueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) return false;
    EGLint type = EGL_OPENGL_ES_API;
    egl_.QueryContext(display, own, EGL_CONTEXT_CLIENT_TYPE, &type);
    const EGLenum program_api = egl_.QueryAPI(), api = static_cast<EGLenum>(type);
    const EGLint embedded[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE}, *none = embedded + 2;
    if (!egl_.BindAPI(api)) return false;
    const EGLContext second =
        egl_.CreateContext(display, drawable.config, own, api == EGL_OPENGL_ES_API ? embedded : none);
    egl_.BindAPI(program_api);
    if (second == EGL_NO_CONTEXT) return false;
    twin.enter = [=, this] { return egl_.BindAPI(api) && bind({display, 0, 0, second}); };
    twin.leave = [=, this] { bind({display, 0, 0, EGL_NO_CONTEXT}); };
    twin.destroy = [=, this] { egl_.DestroyContext(display, second); };
    return true;
  }

  void destroy(void* display, void* context) const override { egl_.DestroyContext(display, context); }

  bool is_pbuffer(const TilepressPresent& present) const {
    constexpr EGLint kUntouched = -1;  // the query leaves the value of a window or pixmap as it is
    EGLint largest = kUntouched;
    egl_.QuerySurface(present.display, surface_of(present), EGL_LARGEST_PBUFFER, &largest);
    return largest != kUntouched;
  }

  std::optional<KnownConfig> config_of(const TilepressPresent& present) {
    EGLint id = 0;
    if (!egl_.QuerySurface(present.display, surface_of(present), EGL_CONFIG_ID, &id)) return std::nullopt;
    return configs_.find({present.display, id, 0}, [&]() -> std::optional<KnownConfig> {
      const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
      EGLConfig config = nullptr;
      EGLint count = 0;
      if (!egl_.ChooseConfig(present.display, wanted, &config, 1, &count) || count != 1) return std::nullopt;
      return KnownConfig{config, format_of(bits_of(present.display, config)),
                         attribute(present.display, config, EGL_SAMPLES) > 0};
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

  bool is_srgb(const TilepressPresent& present) const {
    const char* version = egl_.QueryString(present.display, EGL_VERSION);
    const bool known = holds(egl_.QueryString(present.display, EGL_EXTENSIONS), "EGL_KHR_gl_colorspace") ||
                       (version != nullptr && strncmp(version, "1.5", 3) == 0);
    EGLint encoding = EGL_GL_COLORSPACE_LINEAR;
    return known && egl_.QuerySurface(present.display, surface_of(present), EGL_GL_COLORSPACE, &encoding) &&
           encoding == EGL_GL_COLORSPACE_SRGB;
  }

  const EglFunctions egl_;
};

}  // namespace

std::unique_ptr<PresentSource> make_egl_source(const SourceSettings& settings,
                                               const TilepressPresent& present) {
  const LibrarySymbols library(settings.host, present);
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
  return loaded ? std::make_unique<EglSource>(egl, gl, settings) : nullptr;
}

}  // namespace tilepress
