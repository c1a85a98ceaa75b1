// Structures: FVC, CCD, Algorithm 1 and colour counts for Python.
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "python_values.h"
#include "tilepress/algorithm1.h"
#include "tilepress/color_cdf.h"
#include "tilepress/cost_model.h"
#include "tilepress/fvc_follower.h"
#include "tilepress/plane.h"
#include "tilepress/tiler.h"

namespace tilepress::python {
namespace {

/// Two arrays, colours (uint32) and counts (`Count`), of the entries.
template <class Count, class Entries>
py::tuple columns_of(const Entries& entries) {
  py::array_t<uint32_t> colors(static_cast<py::ssize_t>(entries.size()));
  py::array_t<Count> counts(static_cast<py::ssize_t>(entries.size()));
  for (size_t i = 0; i < entries.size(); ++i) {
    colors.mutable_data()[i] = entries[i].color;
    counts.mutable_data()[i] = entries[i].count;
  }
  return py::make_tuple(colors, counts);
}

/// Feeds an FVC with one frame at a time, in the order of the render tiles.
class PythonFvc {
 public:
  PythonFvc(const std::string& scheme, const std::string& format, const std::string& order,
            uint32_t tile_side);
  void collect(const py::handle& frame);
  py::tuple entries() const { return columns_of<uint32_t>(state_.slots); }
  py::tuple ccd() const { return columns_of<uint32_t>(ccd_); }
  uint64_t samples() const { return state_.samples; }
  double coverage() const;

 private:
  void see(const PixelPlane& plane, uint32_t bx, uint32_t by);
  void keep_ccd();

  const PixelFormat format_;
  const ByteOrder order_;
  const uint32_t tile_side_;
  std::optional<FvcFollower> follower_;
  FvcState state_;
  std::vector<FvcSlot> ccd_;
};

PythonFvc::PythonFvc(const std::string& scheme, const std::string& format, const std::string& order,
                     uint32_t tile_side)
    : format_(format_named(format)), order_(order_named(order)), tile_side_(tile_side) {
  follower_ = FvcFollower::make(value_of(parse_scheme(scheme)), format_);
  if (!follower_)
    throw LibraryError({ErrorKind::kBadValue,
                        "scheme '" + scheme + "': has no FVC: take one with the key fvc, such as dcp"});
  state_ = follower_->state();
}

/// Padding never enters an FVC.
void PythonFvc::see(const PixelPlane& plane, uint32_t bx, uint32_t by) {
  Block block;
  plane.load_block(bx, by, block);
  const uint32_t width = plane.width() - bx * kBlockSide, height = plane.height() - by * kBlockSide;
  uint32_t inside[kBlockPixels] = {}, count = 0;
  for (const uint8_t at : kTraversal)
    if (at % kBlockSide < width && at / kBlockSide < height) inside[count++] = block.pixels[at];
  follower_->see(inside, count);
}

void PythonFvc::collect(const py::handle& frame) {
  const SurfaceView view = view_of(frame, format_, order_, "frame");
  const py::gil_scoped_release others_may_run;
  PixelPlane plane;
  plane.assign(view);
  follower_->begin_frame(0);  // every period collects in frame 0
  for_each_block_in_tiles(plane.blocks_x(), plane.blocks_y(), tile_side_,
                          [&](uint32_t bx, uint32_t by) { see(plane, bx, by); });
  state_ = follower_->state();
  follower_->begin_frame(0);  // builds the CCD
  keep_ccd();
}

/// Puts the counts to the colours of the CCD.
void PythonFvc::keep_ccd() {
  ccd_.clear();
  for (const uint32_t color : follower_->ccd())
    ccd_.push_back(*std::find_if(state_.slots.begin(), state_.slots.end(), [&](const FvcSlot& slot) {
      return slot.count != 0 && slot.color == color;
    }));
}

double PythonFvc::coverage() const {
  uint64_t held = 0;
  for (const FvcSlot& slot : state_.slots) held += slot.count;
  return state_.samples == 0 ? 0.0 : static_cast<double>(held) / static_cast<double>(state_.samples);
}

py::tuple predict(const std::vector<uint32_t>& counts, uint64_t frame_pixels, uint32_t max_width,
                  uint32_t pixel_bits) {
  py::list rounds;
  const uint32_t width = optimal_width(counts, frame_pixels, max_width, pixel_bits,
                                       [&](uint32_t tried, uint64_t covered_pixels, uint64_t bits) {
                                         rounds.append(py::make_tuple(tried, covered_pixels, bits));
                                       });
  return py::make_tuple(width, rounds);
}

py::tuple count_colors(const py::handle& frame, const std::string& format, const std::string& order) {
  const SurfaceView view = view_of(frame, format_named(format), order_named(order), "frame");
  std::vector<ColorCount> counts;
  {
    const py::gil_scoped_release others_may_run;
    counts = color_counts(view);
  }
  return columns_of<uint64_t>(counts);
}

}  // namespace

void bind_structures(py::module_& module) {
  py::class_<PythonFvc>(module, "Fvc")
      .def(py::init<const std::string&, const std::string&, const std::string&, uint32_t>())
      .def("collect", &PythonFvc::collect)
      .def("entries", &PythonFvc::entries)
      .def("ccd", &PythonFvc::ccd)
      .def("samples", &PythonFvc::samples)
      .def("coverage", &PythonFvc::coverage);
  module.def("predict_ccd_size", &predict);
  module.def("color_counts", &count_colors);
  module.def(
      "color_text",
      [](uint32_t color, const std::string& format) { return color_text(color, format_named(format)); },
      py::arg("color"), py::arg("format") = "rgba8",
      "Returns a pixel word as \"#RRGGBBAA\"; \"#RRRGGGBBBA\" for rgb10a2.");
  module.def(
      "energy_saving", [](double rate) { return energy_saving(rate); }, py::arg("rate"),
      "Returns the share of DRAM energy that DCP saves at a rate (raw / moved bits): 1 - 1/rate - "
      "4.83/451.2.");
}

}  // namespace tilepress::python
