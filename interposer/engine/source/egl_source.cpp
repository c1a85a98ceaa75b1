// EGL source: reads the surface of an eglSwapBuffers in a context of our own on the surface's config.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "interposer/engine/source/config_cache.h"
#include "interposer/engine/readback/context_pool.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/readback/gl_readback.h"
#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/source/library_symbols.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/readback/pixel_buffer_groups.h"
#include "interposer/engine/source/present_source.h"

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
  decltype(&eglGetError) GetError = nullptr;
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglQueryAPI) QueryAPI = nullptr;
  decltype(&eglQueryContext) QueryContext = nullptr;
  decltype(&eglQueryString) QueryString = nullptr;
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
           fill(GetCurrentSurface, "eglGetCurrentSurface") && fill(GetError, "eglGetError") &&
           fill(GetProcAddress, "eglGetProcAddress") && fill(QueryContext, "eglQueryContext") &&
           fill(QueryString, "eglQueryString") && fill(MakeCurrent, "eglMakeCurrent") &&
           fill(QueryAPI, "eglQueryAPI") && fill(QuerySurface, "eglQuerySurface");
  }
};

class EglSource final : public PresentSource {
 public:
  EglSource(const EglFunctions& egl, const GlFunctions& gl, LateReader& reader)
      : egl_(egl), gl_(gl), reader_(reader) {}

  bool describe(const TilepressPresent& present, WindowKey& key, SurfaceShape& shape,
                std::string& reason) override {
    const auto surface = reinterpret_cast<EGLSurface>(present.surface);
    if (egl_.GetCurrentContext() == EGL_NO_CONTEXT) return fail(reason, "no context is current");
    if (egl_.GetCurrentDisplay() != present.display) return fail(reason, "another display is current");
    if (egl_.GetCurrentSurface(EGL_DRAW) != surface && egl_.GetCurrentSurface(EGL_READ) != surface)
      return fail(reason, "the surface is not current");
    EGLint width = 0, height = 0;
    if (!egl_.QuerySurface(present.display, surface, EGL_WIDTH, &width) ||
        !egl_.QuerySurface(present.display, surface, EGL_HEIGHT, &height))
      return fail(reason, "eglQuerySurface failed");
    if (width < 1 || height < 1) return fail(reason, "the surface has no pixels");
    const auto config = config_of(present);
    if (!config) return fail(reason, "the surface has no config");
    key = {present.display, present.surface};
    shape = {static_cast<uint32_t>(width), static_cast<uint32_t>(height), config->format, is_srgb(present),
             !is_pbuffer(present)};
    return true;
  }

  bool find_current(TilepressPresent& present, FramebufferUse use) override {
    if (egl_.GetCurrentContext() == EGL_NO_CONTEXT) return false;
    present.display = egl_.GetCurrentDisplay();
    present.surface = reinterpret_cast<uintptr_t>(
        egl_.GetCurrentSurface(use == FramebufferUse::kRead ? EGL_READ : EGL_DRAW));
    return true;
  }
  const void* context() const override { return egl_.GetCurrentContext(); }
  const GlFunctions& gl() const override { return gl_; }

  bool beside(const TilepressPresent&, const std::function<void()>& work, std::string& reason) override {
    const EGLDisplay display = egl_.GetCurrentDisplay();
    const EGLContext context = egl_.GetCurrentContext();
    const EGLSurface draw = egl_.GetCurrentSurface(EGL_DRAW), read = egl_.GetCurrentSurface(EGL_READ);
    const ContextPool::Key key{display, reinterpret_cast<uintptr_t>(context)};
    if (!can_come_back(display)) return fail(reason, "the program's context or surface is destroyed");
    EGLContext own = sharing_.take(key);
    if (own == EGL_NO_CONTEXT) own = create_sharing(display, context);
    const bool bound =
        own != EGL_NO_CONTEXT && (egl_.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, own) ||
                                  egl_.MakeCurrent(display, draw, read, own));
    if (bound) work();
    if (bound && !egl_.MakeCurrent(display, draw, read, context))
      reason = "the program's context could not be made current again";
    if (own != EGL_NO_CONTEXT) sharing_.give(key, own);
    if (!bound) reason = "no private context can share objects with the program's";
    return bound;
  }

  uint32_t take_error() override { return static_cast<uint32_t>(egl_.GetError()); }

  // By doing again what raises it. Of the errors that no harmless call raises, the next call of the program's
  // own finds none.
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

  bool read(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
            std::string& reason) override {
    const bool stay = in_program_context_only() || !can_come_back(present.display);
    return read_either(
        stay, frame, reason, [&] { return read_privately(present, shape, frame, reason); },
        [&] { return read_in_place(present, shape, buffer_of(present), frame, reason); });
  }

  // A read takes from the read surface. Where another is presented, the two change places for as long as the
  // read takes: both stay current, so neither loses its buffers, and Mesa gives neither new ones for a new
  // size, as it does when another context is made current.
  bool read_in_place(const TilepressPresent& present, const SurfaceShape& shape, GLenum buffer,
                     CapturedFrame& frame, std::string& reason) override {
    frame.way = ReadWay::kInContext;
    const auto config = config_of(present);
    if (config && config->multisampled)
      return fail(reason, "a multisampled surface is resolved in a private context alone");
    const EGLDisplay display = present.display;
    const EGLContext context = egl_.GetCurrentContext();
    const EGLSurface draw = egl_.GetCurrentSurface(EGL_DRAW), read = egl_.GetCurrentSurface(EGL_READ);
    const bool change = read != reinterpret_cast<EGLSurface>(present.surface);
    const uint64_t begin_ns = now_ns();
    if (change && !can_come_back(display))
      return fail(reason, "the surface that the program reads from is destroyed");
    if (change && !egl_.MakeCurrent(display, read, draw, context))
      return fail(reason, "the surface cannot be read in the program's context");
    const uint64_t changed_ns = now_ns();
    const bool taken = read_in_program_context(gl_, shape, buffer, frame);
    const uint64_t taken_ns = now_ns();
    if (change && !egl_.MakeCurrent(display, draw, read, context))
      return fail(reason, "the program's context could not be made current again");
    if (change) frame.bind_ns = now_ns() - taken_ns + changed_ns - begin_ns;
    return taken || fail(reason, "the program's context cannot be read");
  }

  void release(void* display) override {
    if (!groups_.of_display(display).empty()) reader_.let_go(display);
    for (ContextPool* pool : {&pool_, &sharing_})
      for (void* own : pool->take_all(display)) {
        const std::shared_ptr<PixelBuffers> buffers = groups_.take(own);
        if (buffers != nullptr && buffers->twin() != nullptr) buffers->twin()->destroy();
        egl_.DestroyContext(display, own);
      }
    configs_.forget(display);
  }

  void trim(void* display) override { trim_later(groups_.of_display(display), reader_); }

  const char* api() const override { return "EGL"; }

 private:
  /// The program has destroyed its context, which lives on until something else is made current.
  bool context_is_destroyed(EGLDisplay display) const {
    EGLint id = 0;
    return !egl_.QueryContext(display, egl_.GetCurrentContext(), EGL_CONFIG_ID, &id);
  }

  /// What is current could be made current again. A surface that the program has destroyed lives on only
  /// until something else is current; its handle is unknown, or, in Mesa, no longer answered.
  bool can_come_back(EGLDisplay display) const {
    const EGLSurface draw = egl_.GetCurrentSurface(EGL_DRAW), read = egl_.GetCurrentSurface(EGL_READ);
    if (context_is_destroyed(display)) return false;
    if (draw == EGL_NO_SURFACE && read == EGL_NO_SURFACE) return true;
    return is_known(display, draw) && is_known(display, read);
  }

  bool is_known(EGLDisplay display, EGLSurface surface) const {
    EGLint id = 0;
    return surface != EGL_NO_SURFACE && egl_.QuerySurface(display, surface, EGL_CONFIG_ID, &id);
  }

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
    const bool taken =
        bound &&
        read_back_buffer(gl_, shape, buffers_of(present.display, config, own, frame.way), frame, error);
    if (taken && frame.late != nullptr) reader_.post(frame);  // before our context may go
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

  bool is_pbuffer(const TilepressPresent& present) const {
    constexpr EGLint kUntouched = -1;  // the answer for a window or pixmap
    EGLint largest = kUntouched;
    egl_.QuerySurface(present.display, reinterpret_cast<EGLSurface>(present.surface), EGL_LARGEST_PBUFFER,
                      &largest);
    return largest != kUntouched;
  }

  GLenum buffer_of(const TilepressPresent& present) const {
    EGLint buffer = EGL_BACK_BUFFER;
    egl_.QuerySurface(present.display, reinterpret_cast<EGLSurface>(present.surface), EGL_RENDER_BUFFER,
                      &buffer);
    return buffer == EGL_BACK_BUFFER || version_of(gl_).embedded ? GL_BACK : GL_FRONT;
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
    const char* extensions = egl_.QueryString(present.display, EGL_EXTENSIONS);
    const char* version = egl_.QueryString(present.display, EGL_VERSION);
    const bool known = (extensions != nullptr && strstr(extensions, "EGL_KHR_gl_colorspace") != nullptr) ||
                       (version != nullptr && strncmp(version, "1.5", 3) == 0);
    EGLint encoding = EGL_GL_COLORSPACE_LINEAR;
    return known &&
           egl_.QuerySurface(present.display, reinterpret_cast<EGLSurface>(present.surface),
                             EGL_GL_COLORSPACE, &encoding) &&
           encoding == EGL_GL_COLORSPACE_SRGB;
  }

  // A context that shares with `other`, which is current: of its API and config, with its way to tell resets.
  EGLContext create_sharing(EGLDisplay display, EGLContext other) const {
    EGLint id = 0, count = 0, type = EGL_OPENGL_ES_API, version = 2;
    EGLConfig config = nullptr;
    egl_.QueryContext(display, other, EGL_CONFIG_ID, &id);
    egl_.QueryContext(display, other, EGL_CONTEXT_CLIENT_TYPE, &type);
    egl_.QueryContext(display, other, EGL_CONTEXT_CLIENT_VERSION, &version);
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
          context = egl_.CreateContext(display, config, other, wish.data());
        }
    egl_.BindAPI(program_api);
    return context;
  }

  /// The pixel buffers of our context `own`, which is current, where they are wanted and can be had.
  std::shared_ptr<PixelBuffers> buffers_of(EGLDisplay display, EGLConfig config, EGLContext own,
                                           ReadWay way) {
    return groups_.of_context(own, way, gl_, display, reader_, [&](TwinContext& twin) {
      const char* extensions = egl_.QueryString(display, EGL_EXTENSIONS);
      if (extensions == nullptr || strstr(extensions, "EGL_KHR_surfaceless_context") == nullptr) return false;
      EGLint type = EGL_OPENGL_ES_API;
      egl_.QueryContext(display, own, EGL_CONTEXT_CLIENT_TYPE, &type);
      const EGLenum program_api = egl_.QueryAPI(), api = static_cast<EGLenum>(type);
      const EGLint embedded[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE}, *none = embedded + 2;
      if (!egl_.BindAPI(api)) return false;
      const EGLContext second =
          egl_.CreateContext(display, config, own, api == EGL_OPENGL_ES_API ? embedded : none);
      egl_.BindAPI(program_api);
      if (second == EGL_NO_CONTEXT) return false;
      twin.enter = [=, this] {
        return egl_.BindAPI(api) && egl_.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, second);
      };
      twin.leave = [=, this] { egl_.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); };
      twin.destroy = [=, this] { egl_.DestroyContext(display, second); };
      return true;
    });
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
  ContextPool pool_;          ///< by config
  ContextPool sharing_;       ///< by the program's context
  PixelBufferGroups groups_;  ///< of the contexts in pool_
  LateReader& reader_;
  ConfigCache configs_;
};

}  // namespace

std::unique_ptr<PresentSource> make_egl_source(const TilepressHost& host, const TilepressPresent& present,
                                               LateReader& reader) {
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
  return loaded ? std::make_unique<EglSource>(egl, gl, reader) : nullptr;
}

}  // namespace tilepress
