// RAS: predictive coding with size classes (Rasmusson et al. 2007 as the paper sets it; spec §6).
//
//   CSB       class of the block, see ras_classes.h
//   payload   the stream of ras_stream.h, zero-padded to the class; or 64 raw pixels
//   tables    none
#include "ras/ras_block.h"
#include "scheme_factory.h"

namespace tilepress {
namespace {

struct RasCoder {
  RasCoder(const SchemeSpec& spec, const FormatTraits& traits, const ModelOptions& model)
      : format(traits),
        ycocg(spec.ycocg),
        classes{spec.ras_sizes, kBlockPixels * traits.pixel_bits, model.burst_bits} {}
  const FormatTraits format;
  const bool ycocg;
  const RasClasses classes;
};

class RasEncoder final : public BlockEncoder {
 public:
  RasEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : coder_(spec, format, model) {}

  SchemeNeeds needs() const override {
    return {.ras = !coder_.ycocg, .ras_ycocg = coder_.ycocg, .raster_to_encode = true};
  }
  void begin_frame(const FrameContext&) override {}
  uint32_t csb_bits() const override { return coder_.classes.csb_bits(); }
  uint64_t palette_bits() const override { return 0; }
  void write_tables(BitWriter&) const override {}
  uint32_t measure(const BlockContext& block) const override {
    return coder_.classes.bits_of(class_of(block));
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const uint32_t cls = class_of(block);
    csb.put(cls, csb_bits());
    ras_block_write(block, cls, coder_.classes, coder_.format, coder_.ycocg, payload);
  }

 private:
  uint32_t class_of(const BlockContext& block) const {
    return coder_.classes.class_of(coder_.ycocg ? block.ras_ycocg_bits : block.ras_bits);
  }
  const RasCoder coder_;
};

class RasDecoder final : public BlockDecoder {
 public:
  RasDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : coder_(spec, format, model) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == coder_.classes.csb_bits();
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto cls = static_cast<uint32_t>(csb.get(coder_.classes.csb_bits()));
    return !csb.overran() && ras_block_read(payload, cls, coder_.classes, coder_.format, coder_.ycocg, out);
  }

 private:
  const RasCoder coder_;
};

}  // namespace

const SchemeInfo kRasInfo = {"ras",
                             "RAS",
                             "median-edge prediction and Golomb-Rice codes, rounded up to size classes",
                             "Rasmusson et al. 2007, with the settings of Gubran et al.",
                             false,
                             true,
                             make_encoder<RasEncoder>,
                             make_decoder<RasDecoder>};

}  // namespace tilepress
