// Engine: a SurfaceEngine for Python. Frames are read where numpy keeps them, and the interpreter's lock is
// free meanwhile.
#include "tilepress/surface_engine.h"

#include <pybind11/stl.h>

#include <atomic>
#include <bit>
#include <optional>

#include "stored_surface.h"
#include "tilepress/scheme.h"

namespace tilepress::python {
namespace {

Result<void> possible(const ModelOptions& model) {
  const auto fail = [](const char* name, uint32_t value, const char* rule) {
    return Error{ErrorKind::kBadValue, std::string(name) + "=" + std::to_string(value) + ": must be " + rule};
  };
  if (model.tile_side % kBlockSide != 0 || model.tile_side < kBlockSide || model.tile_side > 4096)
    return fail("tile_side", model.tile_side, "a multiple of 8 from 8 to 4096");
  if (!std::has_single_bit(model.burst_bits) || model.burst_bits < 16 || model.burst_bits > kMaxRawBlockBits)
    return fail("burst_bits", model.burst_bits, "a power of two from 16 to 2048");
  if (model.toggle_bits != 0 && model.toggle_bits != 16 && model.toggle_bits != 32)
    return fail("toggle_bits", model.toggle_bits, "0, 16 or 32");
  if (model.toggle_bits > model.burst_bits)
    return fail("toggle_bits", model.toggle_bits, "at most burst_bits");
  return {};
}

/// The fields of tilepress.SchemeStatistics.
py::dict as_dict(const SchemeStatistics& figures, const SchemeSpec& spec) {
  py::dict own;
  const auto columns = find_scheme(spec.name)->own_columns();
  for (size_t i = 0; i < columns.size(); ++i) own[columns[i]] = figures.own[i];
  py::dict out;
  out["scheme"] = spec.text;
  out["blocks"] = figures.blocks;
  out["raw_bits"] = figures.raw_bits;
  out["payload_bits"] = figures.payload_bits;
  out["bursts"] = figures.bursts;
  out["burst_bits"] = figures.burst_bits;
  out["csb_bits"] = figures.csb_bits;
  out["palette_bits"] = figures.palette_bits;
  out["extra_bits"] = figures.extra_bits;
  out["checked_blocks"] = figures.checked_blocks;
  out["mismatched_blocks"] = figures.mismatched_blocks;
  out["own"] = std::move(own);
  if (figures.fvc) {
    out["fvc_coverage"] = figures.fvc->coverage;
    out["fvc_relative_coverage"] = figures.fvc->relative_coverage;
  }
  if (figures.toggles) {
    out["toggles"] = figures.toggles->plain;
    out["toggles_dbi"] = figures.toggles->inverted;
    out["raw_toggles"] = figures.toggles->raw_plain;
    out["raw_toggles_dbi"] = figures.toggles->raw_inverted;
  }
  return out;
}

/// The fields of tilepress.FrameMetrics.
py::dict as_dict(const FrameMetrics& metrics) {
  py::dict out;
  out["unique_colors"] = metrics.unique_colors;
  out["entropy"] = metrics.entropy;
  out["pixel_change"] = metrics.pixel_change;
  out["color_change"] = metrics.color_change;
  out["fvc_coverage"] = metrics.fvc_coverage;
  out["fvc_relative_coverage"] = metrics.fvc_relative_coverage;
  out["top100_coverage"] = metrics.top100_coverage;
  return out;
}

/// Set while a call is inside the engine. A second thread, or a scheme that calls back, gets an error.
class Turn {
 public:
  explicit Turn(std::atomic_flag& taken) : taken_(taken) {
    if (taken_.test_and_set())
      throw LibraryError({ErrorKind::kUnsupported, "engine: another thread uses it: make one per thread"});
  }
  ~Turn() { taken_.clear(); }

 private:
  std::atomic_flag& taken_;
};

class PythonEngine {
 public:
  PythonEngine(const std::vector<std::string>& schemes, const std::string& format, const std::string& order,
               const ModelOptions& model);
  py::tuple process(const py::handle& frame, bool wants_bits, bool wants_surfaces);
  std::vector<std::string> schemes() const {
    std::vector<std::string> texts;
    for (const SchemeSpec& spec : specs_) texts.push_back(spec.text);
    return texts;
  }
  uint64_t frames() const { return engine_->frames(); }
  std::vector<uint64_t> history(uint64_t ordinal) { return engine_->history(ordinal, format_); }
  void seek(uint64_t ordinal) { engine_->seek(ordinal); }

 private:
  void check_size(const SurfaceView& view);
  py::dict bits_by_scheme(BlockBits&& bits) const;

  const PixelFormat format_;
  const ByteOrder order_;
  const bool metrics_;
  std::vector<SchemeSpec> specs_;
  std::optional<SurfaceEngine> engine_;
  uint32_t width_ = 0, height_ = 0;  ///< of the surface; 0 before the first frame
  bool broken_ = false;              ///< a scheme raised in the middle of a frame
  std::atomic_flag taken_;
};

PythonEngine::PythonEngine(const std::vector<std::string>& schemes, const std::string& format,
                           const std::string& order, const ModelOptions& model)
    : format_(format_named(format)), order_(order_named(order)), metrics_(model.frame_metrics) {
  require(possible(model));
  for (const std::string& text : schemes)
    for (SchemeSpec& spec : value_of(parse_schemes(text))) {
      bool known = false;
      for (const SchemeSpec& each : specs_) known |= each.text == spec.text;
      if (!known) specs_.push_back(std::move(spec));
    }
  engine_.emplace(specs_, model);
  engine_->history(0, format_);  // makes the encoders here, under the interpreter's lock
}

void PythonEngine::check_size(const SurfaceView& view) {
  const auto side = [](uint32_t width, uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  if (width_ != 0 && (width_ != view.width || height_ != view.height))
    throw LibraryError({ErrorKind::kBadValue, "frame: " + side(view.width, view.height) +
                                                  " pixels, but the surface of this engine has " +
                                                  side(width_, height_) + ": make another engine"});
  width_ = view.width;
  height_ = view.height;
}

py::dict PythonEngine::bits_by_scheme(BlockBits&& bits) const {
  py::dict out;
  for (size_t i = 0; i < specs_.size(); ++i)
    if (!bits.schemes[i].empty())
      out[specs_[i].text.c_str()] = py::array_t<uint16_t>(
          {py::ssize_t{bits.blocks_y}, py::ssize_t{bits.blocks_x}}, bits.schemes[i].data());
  return out;
}

/// Returns the fields of tilepress.FrameStatistics, then bits and surfaces by scheme or None.
py::tuple PythonEngine::process(const py::handle& frame, bool wants_bits, bool wants_surfaces) {
  const SurfaceView view = view_of(frame, format_, order_, "frame");
  const Turn turn(taken_);
  if (broken_)
    throw LibraryError({ErrorKind::kUnsupported,
                        "engine: a scheme raised an exception in an earlier frame: make another engine"});
  check_size(view);
  FrameStatistics figures;
  BlockBits bits;
  std::vector<CompressedSurface> surfaces(wants_surfaces ? specs_.size() : 0);
  figures.frame = engine_->frames();
  engine_->note_block_bits(wants_bits ? &bits : nullptr);
  broken_ = true;
  {
    const py::gil_scoped_release others_may_run;
    engine_->process(view, figures, surfaces);
  }
  broken_ = false;
  engine_->note_block_bits(nullptr);
  py::list schemes;
  py::dict stored;
  for (size_t i = 0; i < specs_.size(); ++i) {
    if (figures.schemes[i].skipped) continue;
    schemes.append(as_dict(figures.schemes[i], specs_[i]));
    if (wants_surfaces)
      stored[specs_[i].text.c_str()] = std::make_unique<StoredSurface>(std::move(surfaces[i]));
  }
  const py::object none = py::none();
  return py::make_tuple(figures.frame, figures.warmup, figures.encode_ns,
                        metrics_ ? py::object(as_dict(figures.metrics)) : none, schemes,
                        wants_bits ? py::object(bits_by_scheme(std::move(bits))) : none,
                        wants_surfaces ? py::object(stored) : none);
}

}  // namespace

void bind_engine(py::module_& module) {
  py::class_<PythonEngine>(module, "Engine")
      .def(py::init([](const std::vector<std::string>& schemes, const std::string& format,
                       const std::string& order, uint32_t tile_side, uint32_t burst_bits, bool verify,
                       bool frame_metrics, uint32_t toggle_bits) {
        return std::make_unique<PythonEngine>(
            schemes, format, order, ModelOptions{tile_side, burst_bits, verify, frame_metrics, toggle_bits});
      }))
      .def("process", &PythonEngine::process)
      .def("schemes", &PythonEngine::schemes)
      .def("frames", &PythonEngine::frames)
      .def("history", &PythonEngine::history)
      .def("seek", &PythonEngine::seek);
}

}  // namespace tilepress::python
