// RAS: predictive coding with size classes (Rasmusson et al. 2007 as the paper sets it).
//
//   CSB       class of the block, see memory/size_classes.h
//   payload   the stream of ras_stream.h, zero-padded to the class; or 64 raw pixels
//   tables    none
#include "ras/ras_bits.h"
#include "ras/ras_block.h"
#include "registry.h"

namespace tilepress {
namespace {

struct RasCoder {
  RasCoder(const SchemeSpec& spec, const FormatTraits& traits, const ModelOptions& model)
      : format(traits),
        ycocg(spec.number("ycocg") == 1),
        classes{static_cast<SizeChoice>(spec.number("sizes")), kBlockPixels * traits.pixel_bits,
                model.burst_bits} {}
  const FormatTraits format;
  const bool ycocg;
  const SizeClasses classes;
};

class RasEncoder final : public BlockEncoder {
 public:
  RasEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : coder_(spec, format, model) {}

  void subscribe(SharedAnalyses& analyses) override {
    bits_ = &analyses.get<RasBits>().subscribe(coder_.ycocg);
  }
  uint32_t csb_bits() const override { return coder_.classes.csb_bits(); }
  uint32_t measure(const BlockContext&) const override { return coder_.classes.bits_of(cls()); }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    csb.put(cls(), csb_bits());
    ras_block_write(block, cls(), coder_.classes, coder_.format, coder_.ycocg, payload);
  }

 private:
  uint32_t cls() const { return coder_.classes.class_of(*bits_); }  ///< of the block at hand
  const RasCoder coder_;
  const uint32_t* bits_ = nullptr;  ///< of its stream
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

constexpr SchemeKey kKeys[] = {{.name = "ycocg",
                                .kind = KeyKind::kChoice,
                                .summary = "transform to Y, Co, Cg, A first",
                                .choices = "0, 1"},
                               {.name = "sizes",
                                .kind = KeyKind::kChoice,
                                .summary = "size classes of a block",
                                .choices = "3, 2, burst"}};

const SchemeInfo kRasInfo = {
    .name = "ras",
    .label = "RAS",
    .family = "ras",
    .group = SchemeGroup::kPaper,
    .summary = "median-edge prediction and Golomb-Rice codes, rounded up to size classes",
    .source = "Rasmusson et al. 2007, with the settings of Gubran et al.",
    .make_encoder = make_encoder<RasEncoder>,
    .make_decoder = make_decoder<RasDecoder>,
    .keys = kKeys};

}  // namespace tilepress
