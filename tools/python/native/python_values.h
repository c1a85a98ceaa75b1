// Python values: arrays of pixels, and errors, on their way between Python and the codec.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <exception>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tilepress/model_options.h"
#include "tilepress/result.h"
#include "tilepress/surface.h"

namespace tilepress::python {
namespace py = pybind11;

/// Reaches Python as tilepress.Error.
struct LibraryError : std::exception {
  explicit LibraryError(Error e) : error(std::move(e)) {}
  const char* what() const noexcept override { return error.text.c_str(); }
  Error error;
};

inline void require(const Result<void>& result) {
  if (!result) throw LibraryError(result.error());
}
template <class T>
T value_of(Result<T> result) {
  if (!result) throw LibraryError(result.error());
  return std::move(*result);
}

/// Returns the format of a name such as "rgba8", in any case.
PixelFormat format_named(const std::string& name);
ByteOrder order_named(const std::string& name);

/// Returns a view of the array's memory, without a copy. Throws for arrays that are not a frame of `format`,
/// and for rows whose pixels are not contiguous. `subject` begins the message.
SurfaceView view_of(const py::handle& frame, PixelFormat format, ByteOrder order, const char* subject);

/// Returns the words as an array of the frame's kind: H×W×4 uint8, H×W uint16 or H×W uint32.
py::array pixels_of(std::span<const uint32_t> words, uint32_t width, uint32_t height, PixelFormat format);

/// Returns a read-only array over memory that `owner` keeps.
template <class T>
py::array array_over(const T* values, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<T> array(std::move(shape), values, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

void bind_engine(py::module_& module);
void bind_schemes(py::module_& module);
void bind_structures(py::module_& module);
void bind_surface(py::module_& module);

}  // namespace tilepress::python
