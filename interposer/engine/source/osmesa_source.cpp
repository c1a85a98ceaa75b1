// OSMesa source: describes the buffer of OSMesaMakeCurrent and reads it through GL. The buffer's memory is up
// to date only after a flush of the program.
#include <GL/gl.h>
#include <GL/glext.h>

#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/source/library_symbols.h"
#include "interposer/engine/source/present_source.h"

namespace tilepress {
namespace {

// From GL/osmesa.h, which Mesa no longer ships (since 25.1).
constexpr GLint kRgba = GL_RGBA, kBgra = 1, kArgb = 2, kRgb565 = 5;
constexpr GLint kWidth = 0x20, kHeight = 0x21, kFormat = 0x22, kType = 0x23;

struct OsmesaFunctions {
  void* (*GetCurrentContext)() = nullptr;
  void (*GetIntegerv)(GLint, GLint*) = nullptr;

  bool load(const LibrarySymbols& library) {
    return library.fill(GetCurrentContext, "OSMesaGetCurrentContext") &&
           library.fill(GetIntegerv, "OSMesaGetIntegerv");
  }
};

class OsmesaSource final : public PresentSource {
 public:
  OsmesaSource(const OsmesaFunctions& osmesa, const GlFunctions& gl) : osmesa_(osmesa), gl_(gl) {}

  const char* api() const override { return "OSMesa"; }
  const GlFunctions& gl() const override { return gl_; }

  Result<Drawable> describe(const TilepressPresent&) override {
    const GLint width = query(kWidth), height = query(kHeight);
    if (width < 1 || height < 1) return unreadable("no buffer is current");
    return Drawable{{context(), 0}, {static_cast<uint32_t>(width), static_cast<uint32_t>(height), format()}};
  }

  Result<void> read(const TilepressPresent& present, const Drawable& drawable,
                    CapturedFrame& frame) override {
    return read_in_place(present, drawable, GL_FRONT, frame);
  }

  Result<void> read_in_place(const TilepressPresent&, const Drawable& drawable, GLenum buffer,
                             CapturedFrame& frame) override {
    frame.way = ReadWay::kInContext;
    if (read_in_program_context(gl_, drawable.shape, buffer, frame)) return {};
    return unreadable("the program's context cannot be read");
  }

  Result<void> beside(const TilepressPresent&, const std::function<void()>&) override {
    return unreadable("an OSMesa context is alone on its thread");
  }

  bool find_current(TilepressPresent& present, FramebufferUse) override {
    present.display = nullptr;
    present.surface = 0;
    return osmesa_.GetCurrentContext() != nullptr;
  }
  const void* context() const override { return osmesa_.GetCurrentContext(); }
  void release(void*) override {}

 private:
  GLint query(GLint name) const {
    GLint value = 0;
    osmesa_.GetIntegerv(name, &value);
    return value;
  }

  /// No modelled format has 24-bit pixels, or floats or 16 bits per channel.
  std::optional<PixelFormat> format() const {
    const GLint type = query(kType);
    switch (query(kFormat)) {
      case kRgba:
      case kBgra:
      case kArgb:
        return type == GL_UNSIGNED_BYTE ? std::optional(PixelFormat::kRgba8) : std::nullopt;
      case kRgb565:
        return type == GL_UNSIGNED_SHORT_5_6_5 ? std::optional(PixelFormat::kRgb565) : std::nullopt;
      default:
        return std::nullopt;
    }
  }

  const OsmesaFunctions osmesa_;
  const GlFunctions gl_;
};

}  // namespace

std::unique_ptr<PresentSource> make_osmesa_source(const SourceSettings& settings,
                                                  const TilepressPresent& present) {
  const LibrarySymbols library(settings.host, present);
  OsmesaFunctions osmesa;
  GlFunctions gl;
  if (!osmesa.load(library)) return nullptr;
  const auto get = reinterpret_cast<void* (*)(const char*)>(library.find("OSMesaGetProcAddress"));
  if (get == nullptr || !gl.load([&](const char* name) { return get(name); })) return nullptr;
  return std::make_unique<OsmesaSource>(osmesa, gl);
}

}  // namespace tilepress
