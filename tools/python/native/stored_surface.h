// Stored surface: a compressed frame with a reader of its own, for Python.
#pragma once

#include <mutex>

#include "python_values.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/surface_reader.h"

namespace tilepress::python {

class StoredSurface {
 public:
  explicit StoredSurface(CompressedSurface&& surface) : surface_(std::move(surface)) {}
  // The reader refers to the surface.
  StoredSurface(const StoredSurface&) = delete;
  StoredSurface& operator=(const StoredSurface&) = delete;

  const CompressedSurface& surface() const { return surface_; }
  /// The bits of a block, in whole bytes.
  py::bytes payload(uint32_t bx, uint32_t by) const;
  py::bytes csb(uint32_t bx, uint32_t by) const;
  py::array read(uint32_t x, uint32_t y, uint32_t width, uint32_t height);
  py::array read_block(uint32_t bx, uint32_t by);
  py::dict traffic();

 private:
  uint64_t number_of(uint32_t bx, uint32_t by) const;
  void open();

  const CompressedSurface surface_;
  SurfaceReader reader_;
  bool open_ = false;
  std::mutex reading_;  ///< taken without the interpreter's lock
};

}  // namespace tilepress::python
