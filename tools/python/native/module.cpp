// Module: tilepress._native, what the Python files of the package stand on.
#include <algorithm>
#include <cctype>
#include <cstring>

#include "python_values.h"
#include "tilepress/plugin_scheme.h"

namespace tilepress::python {
namespace {

const char* name_of(ErrorKind kind) {
  constexpr const char* kNames[] = {"bad value", "file", "bad bits", "exists", "unsupported", "system"};
  return kNames[static_cast<size_t>(kind)];
}

void set_error(const Error& error) {
  const py::object type = py::module_::import("tilepress._errors").attr("Error");
  PyErr_SetObject(type.ptr(), type(error.text, name_of(error.kind)).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const LibraryError& e) {
    set_error(e.error);
  } catch (const PluginFault& fault) {
    set_error({ErrorKind::kSystem, fault.what()});
  }
}

[[noreturn]] void refuse(const char* subject, std::string text) {
  throw LibraryError(about(subject, {ErrorKind::kBadValue, std::move(text)}));
}

std::string text_of(const py::handle& value) {
  return py::str(value).cast<std::string>();
}

bool is_pixel_array(const py::array& array, PixelFormat format) {
  switch (traits(format).pixel_bits) {
    case 16:
      return array.ndim() == 2 && py::isinstance<py::array_t<uint16_t>>(array);
    default:
      if (format == PixelFormat::kRgb10a2)
        return array.ndim() == 2 && py::isinstance<py::array_t<uint32_t>>(array);
      return array.ndim() == 3 && array.shape(2) == 4 && py::isinstance<py::array_t<uint8_t>>(array);
  }
}

const char* array_kind(PixelFormat format) {
  if (format == PixelFormat::kRgb565) return "H×W uint16";
  return format == PixelFormat::kRgb10a2 ? "H×W uint32" : "H×W×4 uint8";
}

}  // namespace

PixelFormat format_named(const std::string& name) {
  std::string known;
  for (size_t i = 0; i < std::size(kFormatTraits); ++i) {
    const std::string_view each = kFormatTraits[i].name;
    if (!kFormatTraits[i].modelled) continue;
    if (std::equal(name.begin(), name.end(), each.begin(), each.end(),
                   [](unsigned char a, unsigned char b) { return std::toupper(a) == b; }))
      return static_cast<PixelFormat>(i);
    known += known.empty() ? "" : ", ";
    for (const unsigned char letter : each) known += static_cast<char>(std::tolower(letter));
  }
  refuse("format", "'" + name + "' is not a format (there are " + known + ")");
}

ByteOrder order_named(const std::string& name) {
  if (name == "rgba") return ByteOrder::kRgba;
  if (name == "bgra") return ByteOrder::kBgra;
  refuse("order", "'" + name + "' is not an order of bytes (rgba or bgra)");
}

SurfaceView view_of(const py::handle& frame, PixelFormat format, ByteOrder order, const char* subject) {
  if (!py::isinstance<py::array>(frame))
    throw py::type_error(std::string(subject) + ": must be a numpy array, not " +
                         text_of(py::type::of(frame).attr("__name__")));
  const auto array = py::reinterpret_borrow<py::array>(frame);
  if (!is_pixel_array(array, format))
    refuse(subject, "shape " + text_of(array.attr("shape")) + " of " + text_of(array.dtype()) + ": " +
                        std::string(traits(format).name) + " frames are arrays of " + array_kind(format));
  const py::ssize_t pixel_bytes = traits(format).pixel_bits / 8;
  if (array.shape(0) < 1 || array.shape(1) < 1 || array.shape(0) > kMaxSurfaceSide ||
      array.shape(1) > kMaxSurfaceSide)
    refuse(subject, "shape " + text_of(array.attr("shape")) + ": sides are 1 to 65535 pixels");
  const bool tight = (array.shape(1) == 1 || array.strides(1) == pixel_bytes) &&
                     (array.ndim() == 2 || array.strides(2) == 1);
  if (!tight) refuse(subject, "the pixels of a row are not contiguous: pass numpy.ascontiguousarray(frame)");
  return {.top_row = static_cast<const std::byte*>(array.data()),
          .pitch_bytes = array.strides(0),
          .width = static_cast<uint32_t>(array.shape(1)),
          .height = static_cast<uint32_t>(array.shape(0)),
          .format = format,
          .order = pixel_bytes == 4 && format != PixelFormat::kRgb10a2 ? order : ByteOrder::kNative};
}

py::array pixels_of(std::span<const uint32_t> words, uint32_t width, uint32_t height, PixelFormat format) {
  const py::ssize_t w = width, h = height;
  if (format == PixelFormat::kRgb565) {
    py::array_t<uint16_t> narrow({h, w});
    std::transform(words.begin(), words.end(), narrow.mutable_data(),
                   [](uint32_t word) { return static_cast<uint16_t>(word); });
    return narrow;
  }
  if (format == PixelFormat::kRgb10a2) return py::array_t<uint32_t>({h, w}, words.data());
  py::array_t<uint8_t> bytes({h, w, py::ssize_t{4}});
  std::memcpy(bytes.mutable_data(), words.data(), words.size_bytes());
  return bytes;
}

}  // namespace tilepress::python

PYBIND11_MODULE(_native, module) {
  namespace here = tilepress::python;
  pybind11::register_exception_translator(here::translate);
  module.attr("version") = TILEPRESS_VERSION;
  here::bind_surface(module);
  here::bind_engine(module);
  here::bind_structures(module);
  here::bind_schemes(module);
}
