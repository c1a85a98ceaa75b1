// OSMesa source: the buffer that OSMesaMakeCurrent named, read through GL, because the memory itself follows
// the rendering only when the program flushes.
#include <GL/gl.h>
#include <GL/glext.h>

#include "interposer/engine/readback/gl_readback.h"
#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/source/library_symbols.h"
#include "interposer/engine/source/present_source.h"

namespace tilepress {
namespace {

// Of GL/osmesa.h, which a machine that builds need not have (Mesa dropped OSMesa in 25.1).
constexpr GLint kRgba = GL_RGBA, kBgra = 1, kArgb = 2, kRgb565 = 5;
constexpr GLint kWidth = 0x20, kHeight = 0x21, kFormat = 0x22, kType = 0x23;

struct OsmesaFunctions {
  void* (*GetCurrentContext)() = nullptr;
  void (*GetIntegerv)(GLint, GLint*) = nullptr;

  bool load(const LibrarySymbols& library) {
    GetCurrentContext =
        reinterpret_cast<decltype(GetCurrentContext)>(library.find("OSMesaGetCurrentContext"));
    GetIntegerv = reinterpret_cast<decltype(GetIntegerv)>(library.find("OSMesaGetIntegerv"));
    return GetCurrentContext != nullptr && GetIntegerv != nullptr;
  }
};

class OsmesaSource final : public PresentSource {
 public:
  OsmesaSource(const OsmesaFunctions& osmesa, const GlFunctions& gl) : osmesa_(osmesa), gl_(gl) {}

  bool describe(const TilepressPresent&, WindowKey& key, SurfaceShape& shape, std::string& reason) override {
    const GLint width = ask(kWidth), height = ask(kHeight);
    if (width < 1 || height < 1) {
      reason = "no buffer is current";
      return false;
    }
    key = {context(), 0};
    shape = {static_cast<uint32_t>(width), static_cast<uint32_t>(height), format()};
    return true;
  }

  bool read(const TilepressPresent& present, const SurfaceShape& shape, CapturedFrame& frame,
            std::string& reason) override {
    return read_in_place(present, shape, GL_FRONT, frame, reason);
  }

  bool read_in_place(const TilepressPresent&, const SurfaceShape& shape, GLenum buffer, CapturedFrame& frame,
                     std::string& reason) override {
    frame.way = ReadWay::kInContext;
    if (read_in_program_context(gl_, shape, buffer, frame)) return true;
    return fail(reason, "the program's context cannot be read");
  }

  bool find_current(TilepressPresent& present, FramebufferUse) override {
    present.display = nullptr;
    present.surface = 0;
    return osmesa_.GetCurrentContext() != nullptr;
  }
  const void* context() const override { return osmesa_.GetCurrentContext(); }
  const GlFunctions& gl() const override { return gl_; }
  bool beside(const TilepressPresent&, const std::function<void()>&, std::string& reason) override {
    reason = "an OSMesa context is alone on its thread";
    return false;
  }
  void release(void*) override {}

  const char* api() const override { return "OSMesa"; }

 private:
  GLint ask(GLint question) const {
    GLint value = 0;
    osmesa_.GetIntegerv(question, &value);
    return value;
  }

  /// Pixels of 24 bits, and of floats or 16 bits a channel, are none of the modelled formats.
  std::optional<PixelFormat> format() const {
    const GLint type = ask(kType);
    switch (ask(kFormat)) {
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

std::unique_ptr<PresentSource> make_osmesa_source(const TilepressHost& host,
                                                  const TilepressPresent& present) {
  const LibrarySymbols library(host, present);
  OsmesaFunctions osmesa;
  GlFunctions gl;
  if (!osmesa.load(library)) return nullptr;
  const auto get = reinterpret_cast<void* (*)(const char*)>(library.find("OSMesaGetProcAddress"));
  if (get == nullptr || !gl.load([&](const char* name) { return get(name); })) return nullptr;
  return std::make_unique<OsmesaSource>(osmesa, gl);
}

}  // namespace tilepress
