// FreqVals: Huffman codes over the FVC's colours with an escape (frequent values, Yang et al. 2000).
//
//   CSB       bursts of the block, 0 = raw: ceil(log2(raw / burst + 1)) bits, see memory/size_classes.h
//   payload   |code| or |escape code|pixel 32| for each pixel in traversal order, fewer than 2048 bits; or 64
//             raw pixels
//   tables    |v|color 32| N ×, then |length 6| N ×, then |length of the escape 6|; v = valid, lengths of
//             invalid slots are 0
//
// Modelling decisions. The codes are those of HuffDCP with one more leaf, the escape, which comes last. Its
// weight is the number of sampled pixels that the FVC does not count: pixels sampled − Σ counts. The escape
// is a leaf even where that is 0. The original is trained once; here the codes come from the frame before, as
// in DCP. So the difference to HuffDCP is the escape for each pixel instead of a raw sub-block. A block that
// would take 2048 bits or more is raw, and so is each block of a frame without a table.
#include <algorithm>
#include <array>

#include "dcp/ccd_view.h"
#include "dictionary/color_table.h"
#include "dictionary/huffman.h"
#include "memory/size_classes.h"
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kPixelBits = 32, kLengthBits = 6;
constexpr uint32_t kRawBits = kBlockPixels * kPixelBits;
constexpr uint32_t kSlotBits = 1 + kPixelBits + kLengthBits;

SizeClasses burst_classes(const ModelOptions& model) {
  return {SizeChoice::kBurst, kRawBits, model.burst_bits};
}

class FreqValsEncoder final : public BlockEncoder {
 public:
  FreqValsEncoder(const SchemeSpec& spec, const FormatTraits&, const ModelOptions& model)
      : fvc_(fvc_config(spec)), classes_(burst_classes(model)) {}

  void subscribe(SharedAnalyses& analyses) override { view_ = &analyses.provided<CcdSource>().view_of(fvc_); }
  void begin_frame(const FrameContext&) override {
    ccd_ = view_->ccd;
    if (ccd_ == nullptr) return;
    std::vector<uint32_t> weights = ccd_->counts;
    uint64_t uncounted = ccd_->samples;
    for (const uint32_t count : ccd_->counts) uncounted -= count;
    weights.push_back(static_cast<uint32_t>(uncounted));
    escape_ = static_cast<uint32_t>(ccd_->counts.size());
    code_.assign(huffman_lengths(weights));
    for (uint32_t i = 0; i <= escape_; ++i) bits_[i] = static_cast<uint8_t>(code_.length(i));
    bits_[escape_] += kPixelBits;
  }
  uint32_t csb_bits() const override { return classes_.csb_bits(); }
  uint64_t palette_bits() const override {
    return ccd_ == nullptr ? 0 : uint64_t{ccd_->entries} * kSlotBits + kLengthBits;
  }
  void write_tables(BitWriter& out) const override {
    if (ccd_ == nullptr) return;
    write_colors(ccd_->colors, ccd_->entries, kPixelBits, out);
    for (uint32_t i = 0; i < ccd_->entries; ++i) out.put(i < escape_ ? code_.length(i) : 0, kLengthBits);
    out.put(code_.length(escape_), kLengthBits);
  }
  uint32_t measure(const BlockContext& block) const override {
    return std::min(stream_bits(block.uniform), kRawBits);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const uint32_t bits = stream_bits(block.uniform);
    const bool raw = bits >= kRawBits;
    csb.put(raw ? 0 : (bits + classes_.burst_bits - 1) / classes_.burst_bits, csb_bits());
    if (raw) return write_raw_block(block.pixels, kPixelBits, payload);
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      const uint32_t symbol = symbol_at(i);
      payload.put(code_.code(symbol), code_.length(symbol));
      if (symbol == escape_) payload.put(block.pixels[i], kPixelBits);
    }
  }
  std::optional<FvcFigures> fvc_figures() const override { return view_->collected; }

 private:
  uint32_t symbol_at(uint32_t pixel) const { return std::min<uint32_t>(view_->indices[pixel], escape_); }
  /// Returns the bits of the codes of the block at hand; kRawBits without a table.
  uint32_t stream_bits(bool uniform) const {
    if (ccd_ == nullptr) return kRawBits;
    if (uniform) return kBlockPixels * bits_[symbol_at(0)];
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kBlockPixels; ++i) bits += bits_[symbol_at(i)];
    return bits;
  }
  const FvcConfig fvc_;
  const SizeClasses classes_;
  const CcdView* view_ = nullptr;
  const Ccd* ccd_ = nullptr;  ///< in force for the frame; null while there is none
  CanonicalCode code_;
  uint32_t escape_ = 0;                          ///< its symbol, the number of colours
  std::array<uint8_t, kMostColors + 1> bits_{};  ///< of a pixel by symbol
};

class FreqValsDecoder final : public BlockDecoder {
 public:
  FreqValsDecoder(const SchemeSpec& spec, const FormatTraits&, const ModelOptions& model)
      : entries_(spec.number("fvc")), classes_(burst_classes(model)) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    has_table_ = false;
    if (csb_bits != classes_.csb_bits()) return false;
    if (table_bits == 0) return true;  // every block is raw
    has_table_ = read_table(tables, table_bits);
    return has_table_;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto bursts = static_cast<uint32_t>(csb.get(classes_.csb_bits()));
    if (bursts == 0) {
      read_raw_block(payload, kPixelBits, out);
      return !csb.overran() && !payload.overran();
    }
    if (!has_table_) return false;
    const uint64_t begin = payload.position();
    for (const uint8_t place : kTraversal) {
      uint32_t symbol = 0;
      if (!code_.read(payload, symbol)) return false;
      out.pixels[place] = symbol < table_.colors().size() ? table_.colors()[symbol]
                                                          : static_cast<uint32_t>(payload.get(kPixelBits));
    }
    const uint64_t bits = payload.position() - begin;
    return bits < kRawBits && (bits + classes_.burst_bits - 1) / classes_.burst_bits == bursts &&
           !csb.overran() && !payload.overran();
  }

 private:
  bool read_table(BitReader& tables, uint64_t table_bits) {
    if (table_bits % kSlotBits != kLengthBits) return false;
    const uint64_t slots = table_bits / kSlotBits;
    if (slots > entries_ || !table_.read(tables, slots, kPixelBits)) return false;
    std::vector<uint8_t> lengths;
    for (uint64_t i = 0; i < slots; ++i) {
      const auto length = static_cast<uint8_t>(tables.get(kLengthBits));
      if ((length != 0) != (i < table_.colors().size())) return false;
      if (length != 0) lengths.push_back(length);
    }
    lengths.push_back(static_cast<uint8_t>(tables.get(kLengthBits)));
    return !tables.overran() && code_.assign(lengths);
  }
  const uint32_t entries_;
  const SizeClasses classes_;
  bool has_table_ = false;
  ColorTable table_;
  CanonicalCode code_;
};

}  // namespace

const SchemeInfo kFreqValsInfo = {
    .name = "freqvals",
    .label = "FreqVals",
    .family = "freqvals",
    .group = SchemeGroup::kLiterature,
    .summary =
        "Huffman codes over the FVC's colours of the frame before, with an escape for each other pixel",
    .source = "Yang et al. 2000, trained again in each frame",
    .make_encoder = make_encoder<FreqValsEncoder>,
    .make_decoder = make_decoder<FreqValsDecoder>,
    .keys = {kDcpKeys.data(), kFvcKeys},
    .check = check_dcp_keys,
    .eight_bit_only = true};

}  // namespace tilepress
