// GLX source: reads the drawable of a glXSwapBuffers in a context of our own on the current context's config.
#include <GL/glx.h>
#include <GL/glxext.h>

#include "interposer/engine/source/config_cache.h"
#include "interposer/engine/readback/context_pool.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/display_ends.h"
#include "interposer/engine/source/display_locks.h"
#include "interposer/engine/source/drawable_size.h"
#include "interposer/engine/readback/gl_readback.h"
#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/source/library_symbols.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/readback/pixel_buffer_groups.h"
#include "interposer/engine/source/present_source.h"

namespace tilepress {
namespace {

using CloseHook = int (*)(Display*, XExtCodes*);

struct GlxFunctions {
  decltype(&glXChooseFBConfig) ChooseFBConfig = nullptr;
  decltype(&glXCreateNewContext) CreateNewContext = nullptr;
  decltype(&glXDestroyContext) DestroyContext = nullptr;
  PFNGLXGETCONTEXTIDEXTPROC GetContextIDEXT = nullptr;  ///< may be null
  decltype(&glXGetCurrentContext) GetCurrentContext = nullptr;
  decltype(&glXGetCurrentDisplay) GetCurrentDisplay = nullptr;
  decltype(&glXGetCurrentDrawable) GetCurrentDrawable = nullptr;
  decltype(&glXGetCurrentReadDrawable) GetCurrentReadDrawable = nullptr;
  decltype(&glXGetFBConfigAttrib) GetFBConfigAttrib = nullptr;
  decltype(&glXGetProcAddressARB) GetProcAddressARB = nullptr;
  decltype(&glXIsDirect) IsDirect = nullptr;
  decltype(&glXMakeContextCurrent) MakeContextCurrent = nullptr;
  decltype(&glXQueryContext) QueryContext = nullptr;
  decltype(&glXQueryDrawable) QueryDrawable = nullptr;
  decltype(&XDefaultScreen) DefaultScreenOf = nullptr;
  decltype(&XFree) Free = nullptr;
  decltype(&XAddExtension) AddExtension = nullptr;
  CloseHook (*SetCloseDisplay)(Display*, int, CloseHook) = nullptr;

  bool load(const LibrarySymbols& library) {
    const auto fill = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(library.find(name));
      return function != nullptr;
    };
    fill(GetContextIDEXT, "glXGetContextIDEXT");
    return fill(ChooseFBConfig, "glXChooseFBConfig") && fill(CreateNewContext, "glXCreateNewContext") &&
           fill(DestroyContext, "glXDestroyContext") && fill(GetCurrentContext, "glXGetCurrentContext") &&
           fill(GetCurrentDisplay, "glXGetCurrentDisplay") &&
           fill(GetCurrentDrawable, "glXGetCurrentDrawable") &&
           fill(GetCurrentReadDrawable, "glXGetCurrentReadDrawable") &&
           fill(GetFBConfigAttrib, "glXGetFBConfigAttrib") &&
           fill(GetProcAddressARB, "glXGetProcAddressARB") && fill(IsDirect, "glXIsDirect") &&
           fill(MakeContextCurrent, "glXMakeContextCurrent") && fill(QueryContext, "glXQueryContext") &&
           fill(QueryDrawable, "glXQueryDrawable") && fill(DefaultScreenOf, "XDefaultScreen") &&
           fill(Free, "XFree") && fill(AddExtension, "XAddExtension") &&
           fill(SetCloseDisplay, "XESetCloseDisplay");
  }
};

class GlxSource final : public PresentSource {
 public:
  GlxSource(const GlxFunctions& glx, const GlFunctions& gl, DrawableSize size, LateReader& reader)
      : glx_(glx), gl_(gl), size_(std::move(size)), reader_(reader) {
    DisplayEnds::instance().add(&pool_, &configs_, [this](const void* display, const auto& contexts) {
      if (!groups_.of_display(display).empty()) reader_.let_go(display);
      for (const void* own : contexts) groups_.take(own);
    });
    DisplayEnds::instance().add(&sharing_, &configs_, nullptr);
  }

  bool describe(const TilepressPresent& present, WindowKey& key, SurfaceShape& shape,
                std::string& reason) override {
    if (!is_current(present)) return describe_idle(present, key, shape, reason);
    Display* display = glx_.GetCurrentDisplay();
    watch_end_of(display);
    unsigned width = 0, height = 0, drawable_config = 0;
    VisualID visual = 0;
    if (!size_.query(display, present.surface, width, height, visual)) {
      // Not a window or pixmap, so a GLX drawable: asking GLX for it raises no X error.
      glx_.QueryDrawable(display, present.surface, GLX_WIDTH, &width);
      glx_.QueryDrawable(display, present.surface, GLX_HEIGHT, &height);
      glx_.QueryDrawable(display, present.surface, GLX_FBCONFIG_ID, &drawable_config);
    }
    const auto& config = described() =
        find_config(present, display, static_cast<int>(drawable_config), visual);
    if (!config) return fail(reason, "the context has no framebuffer config");
    if (width < 1 || height < 1) return fail(reason, "the drawable has no pixels");
    key = {display, present.surface};
    shape = {width, height, config->format, config->srgb_capable && is_srgb(), kResizable};
    return true;
  }

  bool find_current(TilepressPresent& present, FramebufferUse use) override {
    if (glx_.GetCurrentContext() == nullptr) return false;
    present.display = glx_.GetCurrentDisplay();
    present.surface =
        use == FramebufferUse::kRead ? glx_.GetCurrentReadDrawable() : glx_.GetCurrentDrawable();
    return true;
  }
  const void* context() const override { return glx_.GetCurrentContext(); }
  const GlFunctions& gl() const override { return gl_; }

  bool beside(const TilepressPresent& present, const std::function<void()>& work,
              std::string& reason) override {
    const GLXContext context = glx_.GetCurrentContext();
    const GLXDrawable draw = glx_.GetCurrentDrawable(), read = glx_.GetCurrentReadDrawable();
    Display* display = glx_.GetCurrentDisplay();
    if (!can_come_back(present)) return fail(reason, "the program's context or drawable is destroyed");
    const auto config = find_config(present, display, 0, 0);
    const ContextPool::Key key{display, reinterpret_cast<uintptr_t>(context)};
    watch_end_of(display);
    auto own = static_cast<GLXContext>(sharing_.take(key));
    if (own == nullptr && config)
      own = glx_.CreateNewContext(display, static_cast<GLXFBConfig>(config->config), GLX_RGBA_TYPE, context,
                                  glx_.IsDirect(display, context));
    const bool bound = own != nullptr && glx_.MakeContextCurrent(display, draw, read, own);
    if (bound) work();
    if (bound && !glx_.MakeContextCurrent(display, draw, read, context))
      reason = "the program's context could not be made current again";
    if (own != nullptr) sharing_.give(key, own);
    if (!bound) reason = "no private context can share objects with the program's";
    return bound;
  }

  bool read(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
            std::string& reason) override {
    const bool stay = in_program_context_only() || !can_come_back(present);
    if (stay && !is_current(present)) return fail(reason, "the drawable is current nowhere");
    const bool double_buffered = described() && described()->double_buffered;
    const GLenum buffer = double_buffered ? GL_BACK : GL_FRONT;
    return read_either(
        stay, frame, reason, [&] { return read_privately(present, shape, frame, reason); },
        [&] { return read_in_place(present, shape, buffer, frame, reason); });
  }

  // A read takes from the read drawable. Where another is presented, the two change places for as long as the
  // read takes. Both stay current: a plain X window that is not loses its buffers in Mesa. And the context
  // stays: for another one Mesa would give both buffers of the size that they have by now.
  bool read_in_place(const TilepressPresent& present, const SurfaceShape& shape, GLenum buffer,
                     CapturedFrame& frame, std::string& reason) override {
    if (!is_current(present)) return false;
    frame.way = ReadWay::kInContext;
    if (described() && described()->multisampled)
      return fail(reason, "a multisampled surface is resolved in a private context alone");
    Display* display = glx_.GetCurrentDisplay();
    const GLXContext context = glx_.GetCurrentContext();
    const GLXDrawable draw = glx_.GetCurrentDrawable(), read = glx_.GetCurrentReadDrawable();
    const bool change = read != present.surface;
    const uint64_t begin_ns = now_ns();
    if (change && !can_come_back(present))
      return fail(reason, "the drawable that the program reads from is destroyed");
    if (change && !glx_.MakeContextCurrent(display, read, draw, context))
      return fail(reason, "the drawable cannot be read in the program's context");
    const uint64_t changed_ns = now_ns();
    const bool taken = read_in_program_context(gl_, shape, buffer, frame);
    const uint64_t taken_ns = now_ns();
    if (change && !glx_.MakeContextCurrent(display, draw, read, context))
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
        glx_.DestroyContext(static_cast<Display*>(display), static_cast<GLXContext>(own));
      }
  }

  const char* api() const override { return "GLX"; }

 private:
  static constexpr bool kResizable = true;  ///< a pbuffer's number tells nothing else

  /// The program has destroyed its context, which lives on until something else is made current; in Mesa
  /// without a number, which tells where the hooks have not seen it.
  bool context_is_destroyed(const TilepressPresent& present) const {
    if (present.context_destroyed != 0) return true;
    return glx_.GetContextIDEXT != nullptr && glx_.GetCurrentContext() != nullptr &&
           glx_.GetContextIDEXT(glx_.GetCurrentContext()) == None;
  }

  bool is_current(const TilepressPresent& present) const {
    return glx_.GetCurrentContext() != nullptr &&
           (glx_.GetCurrentDrawable() == present.surface || glx_.GetCurrentReadDrawable() == present.surface);
  }

  /// What is current could be made current again. To try that with a drawable that is gone would be an X
  /// error, which ends the program. The one that is presented is there, or presenting it would be such an
  /// error too.
  bool can_come_back(const TilepressPresent& present) const {
    if (glx_.GetCurrentContext() == nullptr) return true;
    if (context_is_destroyed(present)) return false;
    for (const GLXDrawable drawable : {glx_.GetCurrentDrawable(), glx_.GetCurrentReadDrawable()})
      if (drawable != None && drawable != present.surface && !exists(drawable)) return false;
    return true;
  }

  bool exists(GLXDrawable drawable) const {
    Display* display = glx_.GetCurrentDisplay();
    DrawableSize::GlxDrawable found;
    unsigned width = 0, height = 0;
    VisualID visual = 0;
    return size_.query(display, drawable, width, height, visual) || size_.query_glx(display, drawable, found);
  }

  /// The calling thread presents a drawable that it has not current. A window that was made for GLX, or a
  /// pbuffer, keeps its buffers meanwhile, and what is asked about it here raises no X error.
  bool describe_idle(const TilepressPresent& present, WindowKey& key, SurfaceShape& shape,
                     std::string& reason) {
    auto* display = static_cast<Display*>(present.display);
    DrawableSize::GlxDrawable found;
    unsigned width = 0, height = 0;
    VisualID visual = 0;
    if (present.current_elsewhere != 0) return fail(reason, "another thread has the drawable current");
    // A driver may answer for a plain window too, and gives it buffers when ours is made current.
    if (size_.query(display, present.surface, width, height, visual) ||
        !size_.query_glx(display, present.surface, found))
      return fail(reason, "the drawable is current nowhere, where a plain X window has no buffers");
    watch_end_of(display);
    const int screen = found.screen >= 0 ? found.screen : glx_.DefaultScreenOf(display);
    const auto& config = described() =
        known_config(display, screen, GLX_FBCONFIG_ID, static_cast<int>(found.config));
    if (!config) return fail(reason, "the drawable has no framebuffer config");
    key = {display, present.surface};
    shape = {found.width, found.height, config->format,
             config->srgb_capable && glx_.GetCurrentContext() != nullptr && is_srgb(), kResizable};
    return true;
  }

  Attempt read_privately(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
                         std::string& reason) {
    const GLXContext context = glx_.GetCurrentContext();
    const GLXDrawable draw = glx_.GetCurrentDrawable(), read = glx_.GetCurrentReadDrawable();
    Display* before = glx_.GetCurrentDisplay();
    Display* display =
        context != nullptr && is_current(present) ? before : static_cast<Display*>(present.display);
    const auto config = static_cast<GLXFBConfig>(described() ? described()->config : nullptr);
    const ContextPool::Key key{display, reinterpret_cast<uintptr_t>(config)};
    const uint64_t begin_ns = now_ns();
    auto own = static_cast<GLXContext>(pool_.take(key));
    if (own == nullptr)
      own = glx_.CreateNewContext(display, config, GLX_RGBA_TYPE, nullptr,
                                  context == nullptr || glx_.IsDirect(before, context));
    const bool bound =
        own != nullptr && glx_.MakeContextCurrent(display, present.surface, present.surface, own);
    const uint64_t bound_ns = now_ns();
    GLenum error = 0;
    const bool taken =
        bound && read_back_buffer(gl_, shape, buffers_of(display, config, own, frame.way), frame, error);
    if (taken && frame.late != nullptr) reader_.post(frame);  // before our context may go
    const uint64_t taken_ns = now_ns();
    if (bound && !glx_.MakeContextCurrent(context != nullptr ? before : display, draw, read, context)) {
      reason = "the program's context could not be made current again";
      return Attempt::kContextLost;
    }
    frame.bind_ns = now_ns() - begin_ns - (taken_ns - bound_ns);
    if (own != nullptr) pool_.give(key, own);
    if (!taken) reason = bound ? "glReadPixels failed" : "the private context cannot be made current";
    return taken ? Attempt::kRead : Attempt::kNotBound;
  }

  /// The pixel buffers of our context `own`, which is current, where they are wanted and can be had.
  std::shared_ptr<PixelBuffers> buffers_of(Display* display, GLXFBConfig config, GLXContext own,
                                           ReadWay way) {
    return groups_.of_context(own, way, gl_, display, reader_, [&](TwinContext& twin) {
      // Of OpenGL 3.0 on a context can be current without a drawable, which asks the X server nothing.
      if (!has_locks(display) || !glx_.IsDirect(display, own)) return false;
      const GLXContext second = glx_.CreateNewContext(display, config, GLX_RGBA_TYPE, own, True);
      if (second == nullptr) return false;
      twin.enter = [=, this] { return glx_.MakeContextCurrent(display, None, None, second) != False; };
      twin.leave = [=, this] { glx_.MakeContextCurrent(display, None, None, nullptr); };
      twin.destroy = [=, this] { glx_.DestroyContext(display, second); };
      return true;
    });
  }

  void watch_end_of(Display* display) const {
    if (!DisplayEnds::instance().watch(display)) return;
    XExtCodes* codes = glx_.AddExtension(display);
    if (codes != nullptr) glx_.SetCloseDisplay(display, codes->extension, DisplayEnds::on_close);
  }

  /// What describe() found; read() follows on the same thread.
  static std::optional<KnownConfig>& described() {
    static thread_local std::optional<KnownConfig> config;
    return config;
  }

  /// The config that the drawable tells, else that of the current context. Of a context that was made for a
  /// visual (where Mesa answers -1), or that is destroyed (where a driver may ask the X server, for which it
  /// is an error), the window's visual's.
  std::optional<KnownConfig> find_config(const TilepressPresent& present, Display* display,
                                         int drawable_config, VisualID visual) {
    int id = 0, screen = 0;
    const GLXContext context = glx_.GetCurrentContext();
    if (context_is_destroyed(present))
      screen = glx_.DefaultScreenOf(display);
    else if (glx_.QueryContext(display, context, GLX_SCREEN, &screen) != 0)
      return std::nullopt;
    else if (glx_.QueryContext(display, context, GLX_FBCONFIG_ID, &id) != 0)
      id = 0;
    if (drawable_config > 0) id = drawable_config;
    if (id > 0) return known_config(display, screen, GLX_FBCONFIG_ID, id);
    return visual != 0 ? known_config(display, screen, GLX_VISUAL_ID, static_cast<int>(visual))
                       : std::nullopt;
  }

  /// The first config of the screen whose attribute `name` is `number`. Handles live as long as the display.
  std::optional<KnownConfig> known_config(Display* display, int screen, int name, int number) {
    const int key = name == GLX_VISUAL_ID ? ~number : number;  // numbers of either kind are positive
    return configs_.find({display, key, screen}, [&]() -> std::optional<KnownConfig> {
      const int all[] = {GLX_RENDER_TYPE, static_cast<int>(GLX_DONT_CARE), GLX_DRAWABLE_TYPE,
                         static_cast<int>(GLX_DONT_CARE), 0};
      int count = 0;
      GLXFBConfig* found = glx_.ChooseFBConfig(display, screen, all, &count);
      GLXFBConfig config = nullptr;
      for (int i = 0; found != nullptr && i < count && config == nullptr; ++i)
        if (attribute(display, found[i], name) == number) config = found[i];
      if (found != nullptr) glx_.Free(found);
      if (config == nullptr) return std::nullopt;
      return KnownConfig{config, format_of(bits_of(display, config)),
                         attribute(display, config, GLX_SAMPLES) > 0,
                         attribute(display, config, GLX_DOUBLEBUFFER) != 0,
                         attribute(display, config, GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB) != 0};
    });
  }

  /// A visual that could be encoded is, while the program asks for it.
  bool is_srgb() const {
    const ContextVersion version = version_of(gl_);
    GLint enabled = 0;
    if (version.number >= 30 && !version.embedded) gl_.GetIntegerv(GL_FRAMEBUFFER_SRGB, &enabled);
    return enabled != 0;
  }

  int attribute(Display* display, GLXFBConfig config, int name) const {
    int value = 0;
    return glx_.GetFBConfigAttrib(display, config, name, &value) == 0 ? value : 0;
  }

  ChannelBits bits_of(Display* display, GLXFBConfig config) const {
    return {attribute(display, config, GLX_RED_SIZE), attribute(display, config, GLX_GREEN_SIZE),
            attribute(display, config, GLX_BLUE_SIZE), attribute(display, config, GLX_ALPHA_SIZE),
            (attribute(display, config, GLX_RENDER_TYPE) & GLX_RGBA_FLOAT_BIT_ARB) != 0};
  }

  const GlxFunctions glx_;
  const GlFunctions gl_;
  const DrawableSize size_;
  ContextPool pool_;          ///< by config
  ContextPool sharing_;       ///< by the program's context
  PixelBufferGroups groups_;  ///< of the contexts in pool_
  LateReader& reader_;
  ConfigCache configs_;
};

}  // namespace

std::unique_ptr<PresentSource> make_glx_source(const TilepressHost& host, const TilepressPresent& present,
                                               LateReader& reader) {
  const LibrarySymbols library(host, present);
  GlxFunctions glx;
  GlFunctions gl;
  if (!glx.load(library)) return nullptr;
  const bool loaded = gl.load([&](const char* name) -> void* {
    if (present.look_up != nullptr) return present.look_up(name);
    if (void* found = reinterpret_cast<void*>(glx.GetProcAddressARB(reinterpret_cast<const GLubyte*>(name))))
      return found;
    return library.find(name);
  });
  return loaded ? std::make_unique<GlxSource>(glx, gl, DrawableSize(library), reader) : nullptr;
}

}  // namespace tilepress
