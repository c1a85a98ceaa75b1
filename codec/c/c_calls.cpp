// C calls: the error of a thread, and arguments from C.
#include "c/c_calls.h"

#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

struct CError {
  tp_status status = TP_OK;
  std::string text;
};

CError& last_error() {
  static thread_local CError error;
  return error;
}

Error bad_argument(std::string text) {
  return {ErrorKind::kBadValue, std::move(text)};
}

}  // namespace

tp_status c_failure(tp_status status, std::string text) noexcept {
  CError& error = last_error();
  error.status = status;
  error.text = std::move(text);  // an empty text of no memory needs no memory
  return status;
}

Result<CFormat> c_format(uint32_t format) {
  const bool swapped = format >= TP_BGRA8;
  const uint32_t plain = swapped ? format - TP_BGRA8 : format;
  if (plain > (swapped ? TP_RGBX8 : TP_RGB10A2))
    return bad_argument("format " + std::to_string(format) + " is none of TP_RGBA8 and so on");
  return CFormat{static_cast<PixelFormat>(plain), swapped ? ByteOrder::kBgra : ByteOrder::kRgba};
}

Result<COptions> c_options(const tp_options* options) {
  COptions out;
  if (options == nullptr) return out;
  tp_options own{};
  if (options->struct_bytes < 2 * sizeof(uint32_t) || options->struct_bytes > 16 * sizeof own)
    return bad_argument("options: struct_bytes is " + std::to_string(options->struct_bytes) +
                        ", set it to sizeof(tp_options)");
  std::memcpy(&own, options, std::min<size_t>(options->struct_bytes, sizeof own));
  const auto* bytes = reinterpret_cast<const unsigned char*>(options);
  for (size_t i = sizeof own; i < options->struct_bytes; ++i)
    if (bytes[i] != 0) return bad_argument("options: a member is set that this version does not know");
  CompressedSurface surface;  // knows the ranges
  surface.width = surface.height = 1;
  if (own.tile_side != 0) surface.tile_side = own.tile_side;
  if (own.burst_bits != 0) surface.burst_bits = own.burst_bits;
  if (const auto possible = surface.possible(); !possible) return about("options", possible.error());
  if (own.toggle_bits != 0 && own.toggle_bits != 16 && own.toggle_bits != 32)
    return bad_argument("options: toggle_bits must be 0, 16 or 32");
  if (own.toggle_bits > surface.burst_bits)
    return bad_argument("options: toggle_bits must not be more than burst_bits");
  out.model.tile_side = surface.tile_side;
  out.model.burst_bits = surface.burst_bits;
  out.model.toggle_bits = own.toggle_bits;
  out.model.verify = own.verify != 0;
  out.model.frame_metrics = own.no_metrics == 0;
  out.keeps_blocks = own.keep_blocks != 0;
  return out;
}

}  // namespace tilepress

using namespace tilepress;

uint32_t tp_version(void) {
  constexpr uint32_t kVersion = 10000 * TP_VERSION_MAJOR + 100 * TP_VERSION_MINOR + TP_VERSION_PATCH;
  static_assert(kVersion == TILEPRESS_PROJECT_VERSION, "tilepress.h and CMakeLists.txt name different versions");
  return kVersion;
}

const char* tp_error(void) {
  const CError& error = last_error();
  return error.status == TP_NO_MEMORY ? "out of memory" : error.text.c_str();
}

tp_status tp_error_status(void) {
  return last_error().status;
}

const char* tp_scheme_name(uint32_t index) {
  return index < scheme_registry().size() ? scheme_registry()[index].name : nullptr;
}

tp_status tp_register_scheme(const tp_scheme* scheme) {
  return c_call([&] {
    if (scheme == nullptr) return c_failure(TP_BAD_ARGUMENT, "scheme is NULL");
    const auto registered = register_plugin_scheme(*scheme);
    return registered ? TP_OK : c_failure(TP_BAD_SCHEME, registered.error().text);
  });
}
