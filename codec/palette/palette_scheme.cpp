// Palette: indices into a fixed dictionary (Danielson 1998, as the paper describes it: the operating system
// or the program chooses the colours).
//
//   CSB       16 × 1 bit, in sub-block order: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 × M bits of palette index, M = log2(slots)
//                            raw         4 × pixel bits
//   tables    as many slots as the palette has: a valid bit and a colour, (pixel bits + 1) bits each
//
// Modelling decisions. Only the origin of the colours differs from DCP. The dictionary travels with every
// frame (palette_bits), as in DCP.
//   file=PATH    the colours of a file in its order, converted to the surface's format, without repeats;
//   slots = the
//                next power of two. In force from frame 0.
//   from=first   (the default) the `entries` most frequent colours of the surface's first frame. Frame 0 is
//   raw; all
//                later frames use them.
#include <algorithm>
#include <bit>

#include "dictionary/color_table.h"
#include "dictionary/entries_key.h"
#include "dictionary/frequent_colors.h"
#include "palette/palette_file.h"
#include "pixels/raw_bits.h"
#include "registry.h"

namespace tilepress {
namespace {

/// Returns the nearest pixel of `format` to an RGBA8 word. Drops channels that the format lacks; RGBX8 has
/// alpha 255.
uint32_t to_format(uint32_t rgba, const FormatTraits& format) {
  if (format.name == traits(PixelFormat::kRgbx8).name) rgba |= 0xFF000000u;
  uint32_t word = 0;
  for (uint32_t c = 0; c < 4; ++c) {
    const uint32_t bits = format.channel_bits[c];
    if (bits == 0) continue;
    const uint32_t byte = rgba >> 8 * c & 0xFF, largest = (1u << bits) - 1;
    word |= (byte * largest + 127) / 255 << format.channel_shift[c];
  }
  return word;
}

class PaletteEncoder final : public BlockEncoder {
 public:
  PaletteEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : entries_(spec.number("entries")), pixel_bits_(format.pixel_bits) {
    const std::vector<uint32_t>& palette = spec.list("file");
    if (palette.empty()) return;
    std::vector<uint32_t> colors;
    for (const uint32_t rgba : palette) {
      const uint32_t word = to_format(rgba, format);
      if (std::find(colors.begin(), colors.end(), word) == colors.end()) colors.push_back(word);
    }
    table_.assign(std::bit_ceil(static_cast<uint32_t>(colors.size())), colors);
    from_file_ = true;
  }

  SchemeNeeds needs() const override { return {.first_frame = !from_file_, .whole_frame = !from_file_}; }
  void begin_frame(const FrameContext& frame) override {
    if (from_file_) return;
    if (frame.ordinal == 0) {
      first_.clear();
      for (const FrequentColor& entry : most_frequent_colors(frame.plane, entries_))
        first_.push_back(entry.color);
      table_ = ColorTable{};
    } else if (table_.slots() == 0) {
      table_.assign(entries_, first_);
    }
  }
  uint32_t csb_bits() const override { return kSubBlocks; }
  uint64_t palette_bits() const override { return table_.table_bits(pixel_bits_); }
  void write_tables(BitWriter& out) const override { table_.write(pixel_bits_, out); }

  uint32_t measure(const BlockContext& block) const override {
    if (table_.slots() == 0) return kBlockPixels * pixel_bits_;
    const uint32_t raw = kSubBlockPixels * pixel_bits_, compressed = kSubBlockPixels * table_.index_bits();
    if (block.uniform) return kSubBlocks * (table_.find(block.pixels[0]) == kNoColor ? raw : compressed);
    uint32_t bits = 0;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) bits += holds(block, sub) ? compressed : raw;
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const uint32_t* pixels = block.pixels + sub * kSubBlockPixels;
      const bool compressed = table_.slots() != 0 && holds(block, sub);
      csb.put(compressed, 1);
      for (uint32_t i = 0; i < kSubBlockPixels; ++i)
        compressed ? payload.put(table_.find(pixels[i]), table_.index_bits())
                   : payload.put(pixels[i], pixel_bits_);
    }
  }

 private:
  bool holds(const BlockContext& block, uint32_t sub) const {
    for (uint32_t i = 0; i < kSubBlockPixels; ++i)
      if (table_.find(block.pixels[sub * kSubBlockPixels + i]) == kNoColor) return false;
    return true;
  }
  const uint32_t entries_, pixel_bits_;
  bool from_file_ = false;
  std::vector<uint32_t> first_;  ///< colours of the first frame
  ColorTable table_;             ///< no slots while there is no palette
};

/// Uses only the tables, not the specification.
class PaletteDecoder final : public BlockDecoder {
 public:
  PaletteDecoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    table_ = ColorTable{};
    if (csb_bits != kSubBlocks) return false;
    if (table_bits == 0) return true;
    return table_bits % (pixel_bits_ + 1) == 0 &&
           table_.read(tables, table_bits / (pixel_bits_ + 1), pixel_bits_);
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      if (csb.get(1) == 0) {
        read_raw_sub_block(payload, sub, pixel_bits_, out);
        continue;
      }
      if (table_.slots() == 0) return false;
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
        const uint64_t index = payload.get(table_.index_bits());
        if (index >= table_.colors().size()) return false;
        out.pixels[sub_block_pixel(sub, i)] = table_.colors()[index];
      }
    }
    return !csb.overran() && !payload.overran();
  }

 private:
  const uint32_t pixel_bits_;
  ColorTable table_;
};

}  // namespace

constexpr SchemeKey kKeys[] = {{.name = "file",
                                .kind = KeyKind::kFile,
                                .summary = "palette from a file of #RRGGBB or #RRGGBBAA lines",
                                .read_file = read_palette_file},
                               {.name = "from",
                                .kind = KeyKind::kChoice,
                                .summary = "palette from the surface's first frame",
                                .choices = "first"},
                               kEntriesKey};

Result<void> check_keys(const SchemeSpec&, std::span<const std::string_view> given) {
  const auto has = [&](std::string_view key) {
    return std::find(given.begin(), given.end(), key) != given.end();
  };
  if (has("file") && (has("from") || has("entries")))
    return Error{ErrorKind::kBadValue, "from and entries do not go with file"};
  return {};
}

const SchemeInfo kPaletteInfo = {
    .name = "palette",
    .label = "Palette",
    .family = "palette",
    .group = SchemeGroup::kLiterature,
    .summary = "indices into a palette fixed by the user: a file, or the first frame's colours",
    .source = "Danielson 1998, as described in Gubran et al.",
    .make_encoder = make_encoder<PaletteEncoder>,
    .make_decoder = make_decoder<PaletteDecoder>,
    .keys = kKeys,
    .check = check_keys};

}  // namespace tilepress
