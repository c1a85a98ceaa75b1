// GLX source: describes and reads the drawable of a glXSwapBuffers.
#include "interposer/engine/readback/channel_bits.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/drawable_size.h"
#include "interposer/engine/source/glx_functions.h"
#include "interposer/engine/source/session_source.h"
#include "interposer/engine/source/x_display.h"

namespace tilepress {
namespace {

constexpr bool kResizable = true;  // the XID of a pbuffer looks like that of a window

class GlxSource final : public SessionSource {
 public:
  GlxSource(const GlxFunctions& glx, const GlFunctions& gl, const LibrarySymbols& library,
            const SourceSettings& settings)
      : SessionSource(gl, settings), glx_(glx), size_(library) {
    DisplayEnds::instance().add([this](Display* display) {
      session_.forget(display);
      configs_.forget(display);
    });
  }

  const char* api() const override { return "GLX"; }

  Result<Drawable> describe(const TilepressPresent& present) override {
    const bool is_current =
        glx_.GetCurrentContext() != nullptr &&
        (glx_.GetCurrentDrawable() == present.surface || glx_.GetCurrentReadDrawable() == present.surface);
    return is_current ? describe_current(present) : describe_idle(present);
  }

  const void* context() const override { return glx_.GetCurrentContext(); }

  void release(void* display) override { session_.release(display); }

 private:
  Binding current() const override {
    return {glx_.GetCurrentDisplay(), glx_.GetCurrentDrawable(), glx_.GetCurrentReadDrawable(),
            glx_.GetCurrentContext()};
  }

  // To make a drawable current that is gone is an X error, which ends the program. The drawable that is
  // presented is there, or presenting it would be such an error too.
  bool can_come_back(const TilepressPresent& present) const override {
    if (glx_.GetCurrentContext() == nullptr) return true;
    if (context_is_destroyed(present)) return false;
    for (const GLXDrawable drawable : {glx_.GetCurrentDrawable(), glx_.GetCurrentReadDrawable()})
      if (drawable != None && drawable != present.surface && !exists(drawable)) return false;
    return true;
  }

  GLenum buffer_of(const Drawable& drawable) const override {
    return drawable.double_buffered ? GL_BACK : GL_FRONT;
  }

  bool bind(const Binding& to) const override {
    return glx_.MakeContextCurrent(static_cast<Display*>(to.display), to.draw, to.read,
                                   static_cast<GLXContext>(to.context)) != False;
  }

  bool bind_sharing(const Binding& program, void* own) const override {
    return bind({program.display, program.draw, program.read, own});
  }

  void* create_private(const Drawable& drawable, const Binding& program) const override {
    auto* const display = static_cast<Display*>(const_cast<void*>(drawable.key.display));
    const auto context = static_cast<GLXContext>(program.context);
    const Bool direct = context == nullptr || glx_.IsDirect(static_cast<Display*>(program.display), context);
    return glx_.CreateNewContext(display, static_cast<GLXFBConfig>(drawable.config), GLX_RGBA_TYPE, nullptr,
                                 direct);
  }

  void* create_sharing(const TilepressPresent& present, const Binding& program) override {
    auto* const display = static_cast<Display*>(program.display);
    const auto context = static_cast<GLXContext>(program.context);
    const std::optional<KnownConfig> config = find_config(present, display, 0, 0);
    if (!config) return nullptr;
    watch_end_of(display);
    return glx_.CreateNewContext(display, static_cast<GLXFBConfig>(config->config), GLX_RGBA_TYPE, context,
                                 glx_.IsDirect(display, context));
  }

  // From OpenGL 3.0 on a context can be current without a drawable, and the X server gets no request.
  bool create_twin(const Drawable& drawable, void* own, TwinContext& twin) const override {
    Display* const display = glx_.GetCurrentDisplay();
    if (!has_locks(display) || !glx_.IsDirect(display, static_cast<GLXContext>(own))) return false;
    const GLXContext second = glx_.CreateNewContext(display, static_cast<GLXFBConfig>(drawable.config),
                                                    GLX_RGBA_TYPE, static_cast<GLXContext>(own), True);
    if (second == nullptr) return false;
    twin.enter = [=, this] { return bind({display, None, None, second}); };
    twin.leave = [=, this] { bind({display, None, None, nullptr}); };
    twin.destroy = [=, this] { glx_.DestroyContext(display, second); };
    return true;
  }

  void destroy(void* display, void* context) const override {
    glx_.DestroyContext(static_cast<Display*>(display), static_cast<GLXContext>(context));
  }

  Result<Drawable> describe_current(const TilepressPresent& present) {
    Display* display = glx_.GetCurrentDisplay();
    watch_end_of(display);
    unsigned width = 0, height = 0, drawable_config = 0;
    VisualID visual = 0;
    if (!size_.query(display, present.surface, width, height, visual)) {
      // Neither a window nor a pixmap, so a GLX drawable. A GLX query about one raises no X error.
      glx_.QueryDrawable(display, present.surface, GLX_WIDTH, &width);
      glx_.QueryDrawable(display, present.surface, GLX_HEIGHT, &height);
      glx_.QueryDrawable(display, present.surface, GLX_FBCONFIG_ID, &drawable_config);
    }
    const auto config = find_config(present, display, static_cast<int>(drawable_config), visual);
    if (!config) return unreadable("the context has no framebuffer config");
    if (width < 1 || height < 1) return unreadable("the drawable has no pixels");
    return drawable_of(present, display, width, height, *config);
  }

  /// For a drawable that the calling thread has not current. A window that was made for GLX, or a pbuffer,
  /// keeps its buffers meanwhile, and these queries about it raise no X error.
  Result<Drawable> describe_idle(const TilepressPresent& present) {
    auto* const display = static_cast<Display*>(present.display);
    DrawableSize::GlxDrawable found;
    unsigned width = 0, height = 0;
    VisualID visual = 0;
    if (present.current_elsewhere != 0) return unreadable("another thread has the drawable current");
    // A driver may answer for a plain window too, and would give it new buffers for our context.
    if (size_.query(display, present.surface, width, height, visual) ||
        !size_.query_glx(display, present.surface, found))
      return unreadable("the drawable is current nowhere, where a plain X window has no buffers");
    watch_end_of(display);
    const int screen = found.screen >= 0 ? found.screen : glx_.DefaultScreenOf(display);
    const auto config = known_config(display, screen, GLX_FBCONFIG_ID, static_cast<int>(found.config));
    if (!config) return unreadable("the drawable has no framebuffer config");
    return drawable_of(present, display, found.width, found.height, *config);
  }

  Drawable drawable_of(const TilepressPresent& present, Display* display, uint32_t width, uint32_t height,
                       const KnownConfig& config) const {
    return {{display, present.surface},
            {width, height, config.format, config.srgb_capable && encodes_srgb(), kResizable},
            config.config,
            config.double_buffered,
            config.multisampled};
  }

  /// A context that the program has destroyed lives on until something else is current. Mesa then answers
  /// None for its number. The hooks may have seen its end too.
  bool context_is_destroyed(const TilepressPresent& present) const {
    if (present.context_destroyed != 0) return true;
    return glx_.GetContextIDEXT != nullptr && glx_.GetCurrentContext() != nullptr &&
           glx_.GetContextIDEXT(glx_.GetCurrentContext()) == None;
  }

  bool exists(GLXDrawable drawable) const {
    Display* display = glx_.GetCurrentDisplay();
    DrawableSize::GlxDrawable found;
    unsigned width = 0, height = 0;
    VisualID visual = 0;
    return size_.query(display, drawable, width, height, visual) || size_.query_glx(display, drawable, found);
  }

  void watch_end_of(Display* display) const {
    if (!DisplayEnds::instance().watch(display)) return;
    XExtCodes* codes = glx_.AddExtension(display);
    if (codes != nullptr) glx_.SetCloseDisplay(display, codes->extension, DisplayEnds::on_close);
  }

  /// The config of the drawable, else of the current context, else of the window's visual. The visual serves
  /// where Mesa answers -1, for a context that was made for a visual, and for a destroyed context: there a
  /// driver may send the X server a query that is an error.
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

  /// The first config of the screen whose attribute `name` is `number`.
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

  /// Returns true if GL encodes what the program draws to a capable visual.
  bool encodes_srgb() const {
    if (glx_.GetCurrentContext() == nullptr) return false;
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
  const DrawableSize size_;
};

}  // namespace

std::unique_ptr<PresentSource> make_glx_source(const SourceSettings& settings,
                                               const TilepressPresent& present) {
  const LibrarySymbols library(settings.host, present);
  GlxFunctions glx;
  GlFunctions gl;
  if (!glx.load(library)) return nullptr;
  const bool loaded = gl.load([&](const char* name) -> void* {
    if (present.look_up != nullptr) return present.look_up(name);
    if (void* found = reinterpret_cast<void*>(glx.GetProcAddressARB(reinterpret_cast<const GLubyte*>(name))))
      return found;
    return library.find(name);
  });
  return loaded ? std::make_unique<GlxSource>(glx, gl, library, settings) : nullptr;
}

}  // namespace tilepress
