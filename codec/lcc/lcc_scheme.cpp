// LCC: Learned Context Codes. Each pixel is a token and residuals in prefix codes that are learned from the
// frame before, as the paper's palette is. DESIGN.md tells why, and what each part brings.
//
//   CSB       status: ceil(log2(64 + 1 + ceil(2048 / burst bits))) bits, 7 for bursts of 128 bits. It is
//             0 … 63   the whole block has this colour of the CCD: no payload
//             64       raw
//             64 + b   b bursts of payload
//   payload   |first pixel|token|…|token|…|…, raster order, below 2048 bits; or 64 raw pixels
//     first   |1|index M|, or |0|1|R|G|B| if A is 255, or |0|0|R|G|B|A|. Without palette: |1|R|G|B| or
//             |0|R|G|B|A|
//     token   a code of the token's context (lcc_symbols.h), then
//               equal to a neighbour   nothing
//               colour of the CCD      |index M|
//               residual               |class|rest| for the first 1, 3 or 4 of luma, R − G, B − G, alpha
//   tables    |v|color 32| N ×, or nothing; then |code length 4| 1960 ×, or nothing (lcc_codes.h)
//
// The palette is the CCD of the FVC, as in DCP. The code lengths come from the symbols of the frame before. A
// frame may do without either: then no colour of the CCD is used, or fixed codes are.
#include <algorithm>
#include <bit>

#include "dcp/ccd_view.h"
#include "dictionary/color_table.h"
#include "lcc/lcc_model.h"
#include "lcc/lcc_walk.h"
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kRawBits = kBlockPixels * kLccPixelBits;
constexpr uint32_t kRawStatus = kLccSolidColors;
/// The largest palette: its table and the code lengths stay below 4 KiB.
constexpr uint32_t kMostEntries = 512;

uint32_t bursts_of(uint32_t bits, uint32_t burst_bits) {
  return (bits + burst_bits - 1) / burst_bits;
}
uint32_t status_bits(const ModelOptions& model) {
  return static_cast<uint32_t>(std::bit_width(kRawStatus + bursts_of(kRawBits, model.burst_bits)));
}

/// Writes the symbols of a block.
struct SymbolWriter {
  const LccPlanes& planes;
  const LccCodes& codes;
  uint32_t index_bits;
  BitWriter& out;

  void equal(uint32_t symbol, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) codes.write(symbol, out);
  }
  void palette(uint32_t symbol, uint32_t index) {
    codes.write(symbol, out);
    out.put(index, index_bits);
  }
  void residuals(uint32_t symbol, LccToken token, uint32_t pixel) {
    codes.write(symbol, out);
    const uint32_t channels = lcc_residual_channels(token);
    for (uint32_t c = 0; c < channels; ++c) {
      codes.write(planes.symbol[c][pixel] - (channels == 1 ? kLccLumaAlone : 0), out);
      const uint8_t folded = planes.folded[c][pixel];
      const uint32_t bits = lcc_bits_after(lcc_class(folded));
      out.put(lcc_rest(folded, bits), bits);
    }
  }
};

class LccEncoder final : public BlockEncoder {
 public:
  LccEncoder(const SchemeSpec& spec, const FormatTraits&, const ModelOptions& model)
      : fvc_(fvc_config(spec)), burst_bits_(model.burst_bits), status_bits_(status_bits(model)) {}

  SchemeNeeds needs() const override { return {.second_frame_before = true}; }
  void subscribe(SharedAnalyses& analyses) override {
    const CcdView& view = analyses.provided<CcdSource>().view_of(fvc_);
    model_ = &analyses.get<LccSource>().model_of(fvc_, view);
  }
  uint32_t csb_bits() const override { return status_bits_; }
  uint64_t palette_bits() const override {
    return (model_->has_palette() ? model_->palette_bits() : 0) +
           (model_->has_codes() ? LccLengths::kTableBits : 0);
  }
  void write_tables(BitWriter& out) const override {
    if (model_->has_palette()) write_colors(model_->ccd().colors, model_->ccd().entries, kLccPixelBits, out);
    if (model_->has_codes()) model_->lengths().write(out);
  }
  uint32_t measure(const BlockContext& block) const override {
    return model_->is_solid(block) ? 0 : std::min(model_->bits(), kRawBits);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    if (model_->is_solid(block)) return csb.put(model_->first_index(), status_bits_);
    if (model_->bits() >= kRawBits) {
      csb.put(kRawStatus, status_bits_);
      return write_raw_block(block.pixels, kLccPixelBits, payload);
    }
    csb.put(kRawStatus + bursts_of(model_->bits(), burst_bits_), status_bits_);
    write_first(block.pixels[0], payload);
    lcc_walk(model_->planes(), model_->indices(), model_->index_bits(),
             SymbolWriter{model_->planes(), model_->codes(), model_->index_bits(), payload});
  }
  std::optional<FvcFigures> fvc_figures() const override { return model_->view().collected; }

 private:
  void write_first(uint32_t pixel, BitWriter& out) const {
    const uint32_t index = model_->first_index();
    if (model_->has_palette()) out.put(index != kNotInCcd, 1);
    if (index != kNotInCcd) return out.put(index, model_->index_bits());
    const bool opaque = pixel >> 24 == kLccOpaque;
    out.put(opaque, 1);
    for (uint32_t byte = 0; byte < (opaque ? 3 : 4); ++byte) out.put(pixel >> 8 * byte & 255, 8);
  }
  const FvcConfig fvc_;
  const uint32_t burst_bits_, status_bits_;
  LccModel* model_ = nullptr;
};

class LccDecoder final : public BlockDecoder {
 public:
  LccDecoder(const SchemeSpec& spec, const FormatTraits&, const ModelOptions& model)
      : entries_(spec.number("fvc")),
        index_bits_(static_cast<uint32_t>(std::bit_width(entries_) - 1)),
        burst_bits_(model.burst_bits),
        status_bits_(status_bits(model)) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    has_tables_ = false;
    const uint64_t palette_bits = uint64_t{entries_} * (kLccPixelBits + 1);
    has_palette_ = table_bits == palette_bits || table_bits == palette_bits + LccLengths::kTableBits;
    const bool has_codes = table_bits == (has_palette_ ? palette_bits : 0) + LccLengths::kTableBits;
    if (csb_bits != status_bits_ || (!has_palette_ && !has_codes && table_bits != 0)) return false;
    if (has_palette_ && !palette_.read(tables, entries_, kLccPixelBits)) return false;
    LccLengths lengths = LccLengths::fixed();
    if (has_codes) lengths.read(tables);
    has_tables_ = !tables.overran() && codes_.assign(lengths);
    return has_tables_;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    const auto status = static_cast<uint32_t>(csb.get(status_bits_));
    if (csb.overran() || !has_tables_) return false;
    if (status < kLccSolidColors) {
      if (!has_palette_ || status >= palette_.colors().size()) return false;
      out.pixels.fill(palette_.colors()[status]);
      return true;
    }
    if (status == kRawStatus) {
      read_raw_block(payload, kLccPixelBits, out);
      return !payload.overran();
    }
    const uint64_t begin = payload.position();
    if (!read_pixels(payload, out)) return false;
    const uint64_t bits = payload.position() - begin;
    return !payload.overran() && bits < kRawBits &&
           bursts_of(static_cast<uint32_t>(bits), burst_bits_) == status - kRawStatus;
  }

 private:
  bool read_index(BitReader& in, uint32_t& pixel) const {
    const uint64_t index = in.get(index_bits_);
    if (!has_palette_ || index >= palette_.colors().size()) return false;
    pixel = palette_.colors()[index];
    return true;
  }
  bool read_first(BitReader& in, uint32_t& pixel) const {
    if (has_palette_ && in.get(1) != 0) return read_index(in, pixel);
    const bool opaque = in.get(1) != 0;
    pixel = opaque ? kLccOpaque << 24 : 0;
    for (uint32_t byte = 0; byte < (opaque ? 3 : 4); ++byte)
      pixel |= static_cast<uint32_t>(in.get(8)) << 8 * byte;
    return true;
  }
  bool read_pixels(BitReader& in, Block& out) const {
    std::array<LccChannels, kBlockPixels> channels;
    std::array<uint8_t, kBlockPixels> is_residual{};
    if (!read_first(in, out.pixels[0])) return false;
    channels[0] = lcc_channels(out.pixels[0]);
    for (uint32_t i = 1; i < kBlockPixels; ++i) {
      const uint32_t left = kLccNeighbors.left[i], above = kLccNeighbors.above[i],
                     above_left = kLccNeighbors.above_left[i], above_right = kLccNeighbors.above_right[i];
      int gradients = 0;
      for (uint32_t c = 0; c < kLccAlpha; ++c)
        gradients += lcc_gradient(channels[left][c], channels[above][c], channels[above_left][c]);
      const uint32_t shape = lcc_shape(out.pixels[left], out.pixels[above], out.pixels[above_left],
                                       out.pixels[above_right], gradients);
      const uint32_t residuals = uint32_t{is_residual[left]} + is_residual[above];
      uint32_t token = 0;
      if (!codes_.read(lcc_token_symbol(shape, residuals, LccToken::kLeft), in, token)) return false;
      switch (static_cast<LccToken>(token)) {
        case LccToken::kLeft:
          out.pixels[i] = out.pixels[left];
          break;
        case LccToken::kAbove:
          out.pixels[i] = out.pixels[above];
          break;
        case LccToken::kAboveLeft:
          out.pixels[i] = out.pixels[above_left];
          break;
        case LccToken::kAboveRight:
          out.pixels[i] = out.pixels[above_right];
          break;
        case LccToken::kPalette:
          if (!read_index(in, out.pixels[i])) return false;
          break;
        default:
          is_residual[i] = 1;
          if (!read_residual(in, static_cast<LccToken>(token), channels[left], channels[above],
                             channels[above_left], out.pixels[i]))
            return false;
      }
      channels[i] = lcc_channels(out.pixels[i]);
    }
    return true;
  }
  bool read_residual(BitReader& in, LccToken token, const LccChannels& left, const LccChannels& above,
                     const LccChannels& above_left, uint32_t& pixel) const {
    LccChannels channels{};
    const uint32_t alone = token == LccToken::kLuma ? kLccLumaAlone : 0;
    uint8_t before = 0;
    for (uint32_t c = 0; c < 4; ++c) {
      int residual = 0;
      if (c < lcc_residual_channels(token)) {
        const uint8_t gradient = lcc_gradient_class(lcc_gradient(left[c], above[c], above_left[c]));
        uint32_t cls = 0;
        if (!codes_.read(lcc_class_symbol(c, gradient, before) - alone, in, cls)) return false;
        const auto rest = static_cast<uint32_t>(in.get(lcc_bits_after(static_cast<uint8_t>(cls))));
        const uint32_t folded = lcc_folded(cls, rest);
        if (folded > 255) return false;
        residual = static_cast<int>(folded >> 1) ^ -static_cast<int>(folded & 1);
        before = static_cast<uint8_t>(folded);
      }
      const int value = lcc_predict(left[c], above[c], above_left[c]) + residual;
      channels[c] = static_cast<int16_t>(value & 255);
    }
    pixel = lcc_pixel(channels);
    return true;
  }

  const uint32_t entries_, index_bits_, burst_bits_, status_bits_;
  bool has_tables_ = false;  ///< those of the frame were taken; they may be the fixed ones
  bool has_palette_ = false;
  ColorTable palette_;
  LccCodes codes_;
};

Result<void> check_lcc_keys(const SchemeSpec& spec, std::span<const std::string_view> given) {
  if (spec.number("fvc") > kMostEntries)
    return Error{ErrorKind::kBadValue, "fvc=" + std::to_string(spec.number("fvc")) +
                                           ": lcc takes at most 512, so that its tables stay below 4 KiB"};
  return check_dcp_keys(spec, given);
}

}  // namespace

const SchemeInfo kLccInfo = {
    .name = "lcc",
    .label = "LCC",
    .family = "lcc",
    .group = SchemeGroup::kOurs,
    .summary = "Equal neighbours, palette colours and residuals in codes learned from the frame before",
    .source = "made for tilepress: codec/lcc/DESIGN.md",
    .make_encoder = make_encoder<LccEncoder>,
    .make_decoder = make_decoder<LccDecoder>,
    .keys = {kDcpKeys.data(), kFvcKeys},
    .check = check_lcc_keys,
    .eight_bit_only = true};

}  // namespace tilepress
