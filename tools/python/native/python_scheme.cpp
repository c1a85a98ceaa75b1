// Python scheme: encoder and decoder call an instance of the class each. They take the interpreter's lock,
// which the engine released.
#include "python_scheme.h"

#include <pybind11/stl.h>

#include <map>

#include "bit_string.h"

namespace tilepress::python {
namespace {

std::map<std::string, py::object>& classes() {
  static auto& by_name = *new std::map<std::string, py::object>;  // outlives the interpreter
  return by_name;
}

/// The values of the specification by key; a choice as its word.
py::dict values_of(const SchemeSpec& spec) {
  py::dict values;
  const auto keys = find_scheme(spec.name)->keys;
  for (size_t i = 0; i < keys.size(); ++i) {
    const SchemeValue& value = spec.values[i].second;
    if (keys[i].kind == KeyKind::kShare)
      values[keys[i].name] = std::get<double>(value);
    else if (keys[i].kind == KeyKind::kChoice)
      values[keys[i].name] =
          py::str(keys[i].choices).attr("split")(", ")[py::int_(std::get<uint32_t>(value))];
    else
      values[keys[i].name] = std::get<uint32_t>(value);
  }
  return values;
}

PixelFormat format_of(const FormatTraits& format) {
  return format_named(std::string(format.name));
}

/// The instance of the class that one encoder or decoder has.
class Instance {
 public:
  Instance(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : text_(spec.text), format_(format_of(format)) {
    const py::gil_scoped_acquire lock;
    object_ = classes().at(spec.name)(values_of(spec), std::string(format.name), format.pixel_bits,
                                      model.tile_side, model.burst_bits);
  }
  ~Instance() {
    const py::gil_scoped_acquire lock;
    object_ = py::object();
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const py::object& object() const { return object_; }
  PixelFormat format() const { return format_; }
  uint32_t raw_block_bits() const { return kBlockPixels * traits(format_).pixel_bits; }
  [[noreturn]] void refuse(const std::string& text) const {
    throw LibraryError({ErrorKind::kBadValue, "scheme '" + text_ + "': " + text});
  }
  uint32_t whole_number(const py::handle& value, const char* what, uint32_t most) const {
    if (!py::isinstance<py::int_>(value) && !py::hasattr(value, "__index__"))
      refuse(std::string(what) + ": must be a whole number, not " + py::str(value).cast<std::string>());
    const auto number = py::int_(py::reinterpret_borrow<py::object>(value)).cast<long long>();
    if (number < 0 || number > static_cast<long long>(most))
      refuse(std::string(what) + "=" + std::to_string(number) + ": must be from 0 to " +
             std::to_string(most));
    return static_cast<uint32_t>(number);
  }
  py::array pixels(const BlockContext& block) const {
    return pixels_of(block.raster().pixels, kBlockSide, kBlockSide, format_);
  }

 private:
  const std::string text_;
  const PixelFormat format_;
  py::object object_;
};

constexpr uint32_t kMostCsbBits = 128;

class PythonEncoder final : public BlockEncoder {
 public:
  PythonEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : scheme_(spec, format, model) {
    const py::gil_scoped_acquire lock;
    whole_frame_ = scheme_.object().attr("whole_frame").cast<bool>();
    every_block_ = scheme_.object().attr("every_block").cast<bool>();
    measures_ = py::hasattr(scheme_.object(), "measure");
  }
  SchemeNeeds needs() const override { return {.whole_frame = whole_frame_, .place = every_block_}; }
  void begin_frame(const FrameContext& frame) override;
  uint32_t csb_bits() const override { return csb_bits_; }
  uint64_t palette_bits() const override { return tables_.bit_count(); }
  void write_tables(BitWriter& out) const override { tables_.write_to(out); }
  uint32_t measure(const BlockContext& block) const override;
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override;

 private:
  py::array whole(const PixelPlane& plane) const;

  Instance scheme_;
  bool whole_frame_ = false, every_block_ = false, measures_ = false;
  uint32_t csb_bits_ = 0;
  BitSink tables_;
};

py::array PythonEncoder::whole(const PixelPlane& plane) const {
  std::vector<uint32_t> words;
  for (uint32_t y = 0; y < plane.height(); ++y)
    words.insert(words.end(), plane.row(y), plane.row(y) + plane.width());
  return pixels_of(words, plane.width(), plane.height(), scheme_.format());
}

void PythonEncoder::begin_frame(const FrameContext& frame) {
  const py::gil_scoped_acquire lock;
  const py::object pixels = whole_frame_ ? py::object(whole(frame.plane)) : py::none();
  scheme_.object().attr("begin_frame")(frame.ordinal, pixels);
  csb_bits_ = scheme_.whole_number(scheme_.object().attr("csb_bits"), "csb_bits", kMostCsbBits);
  const py::object sink = py::cast(BitSink());
  scheme_.object().attr("write_tables")(sink);
  tables_ = sink.cast<const BitSink&>();
}

uint32_t PythonEncoder::measure(const BlockContext& block) const {
  const py::gil_scoped_acquire lock;
  if (!measures_) return BlockEncoder::measure(block);
  return scheme_.whole_number(scheme_.object().attr("measure")(scheme_.pixels(block)), "measure",
                              scheme_.raw_block_bits());
}

void PythonEncoder::encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const {
  const py::gil_scoped_acquire lock;
  const py::object payload_sink = py::cast(BitSink()), csb_sink = py::cast(BitSink());
  scheme_.object().attr("encode")(scheme_.pixels(block), payload_sink, csb_sink);
  const auto& bits = payload_sink.cast<const BitSink&>();
  const auto& marks = csb_sink.cast<const BitSink&>();
  if (bits.bit_count() > scheme_.raw_block_bits())
    scheme_.refuse("encode wrote " + std::to_string(bits.bit_count()) + " payload bits: a raw block has " +
                   std::to_string(scheme_.raw_block_bits()));
  if (marks.bit_count() != csb_bits_)
    scheme_.refuse("encode wrote " + std::to_string(marks.bit_count()) + " CSB bits: csb_bits is " +
                   std::to_string(csb_bits_));
  bits.write_to(payload);
  marks.write_to(csb);
}

class PythonDecoder final : public BlockDecoder {
 public:
  PythonDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : scheme_(spec, format, model) {}
  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override;
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override;

 private:
  bool take(const py::object& pixels, Block& out) const;

  Instance scheme_;
  uint32_t csb_bits_ = 0;
};

bool PythonDecoder::begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) {
  const py::gil_scoped_acquire lock;
  csb_bits_ = csb_bits;
  scheme_.object().attr("csb_bits") = csb_bits;
  const py::object source = py::cast(std::make_unique<BitSource>(tables, table_bits));
  const py::object accepted = scheme_.object().attr("read_tables")(source, table_bits);
  tables.skip(source.cast<const BitSource&>().position());
  return !accepted.is(py::bool_(false));
}

/// Returns false for None: bits that the scheme does not write.
bool PythonDecoder::take(const py::object& pixels, Block& out) const {
  if (pixels.is_none()) return false;
  const SurfaceView view = view_of(pixels, scheme_.format(), ByteOrder::kRgba, "decode");
  if (view.width != kBlockSide || view.height != kBlockSide) scheme_.refuse("decode: must return 8x8 pixels");
  PixelPlane plane;
  plane.assign(view);
  plane.load_block(0, 0, out);
  return true;
}

bool PythonDecoder::decode(BitReader& csb, BitReader& payload, Block& out) const {
  const py::gil_scoped_acquire lock;
  const py::object marks = py::cast(std::make_unique<BitSource>(csb, csb_bits_));
  const py::object bits = py::cast(std::make_unique<BitSource>(payload, scheme_.raw_block_bits()));
  const bool taken = take(scheme_.object().attr("decode")(marks, bits), out);
  const auto& read = bits.cast<const BitSource&>();
  csb.skip(marks.cast<const BitSource&>().position());
  payload.skip(read.position());
  return taken && !read.overran() && !payload.overran() && !csb.overran();
}

}  // namespace

std::unique_ptr<BlockEncoder> make_python_encoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model) {
  return make_encoder<PythonEncoder>(spec, format, model);
}
std::unique_ptr<BlockDecoder> make_python_decoder(const SchemeSpec& spec, const FormatTraits& format,
                                                  const ModelOptions& model) {
  return make_decoder<PythonDecoder>(spec, format, model);
}

void set_python_class(const std::string& name, const py::object& type) {
  classes()[name] = type;
}
py::object python_class(const std::string& name) {
  const auto found = classes().find(name);
  return found == classes().end() ? py::object(py::none()) : found->second;
}

}  // namespace tilepress::python
