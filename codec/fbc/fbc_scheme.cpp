// FBC: the frame's own Huffman dictionary, built after rendering (Shim et al. 2005, as the paper has it).
//
//   CSB       16 × 1 bit, in sub-block order: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 canonical codes, fewer than 4 × pixel bits together
//                            raw         4 × pixel bits
//   tables    `entries` slots of a valid bit and a colour, then as many code lengths of 6 bits (0 in
//             invalid slots)
//
// Modelling decisions. The codes stand for the `entries` most frequent colours of the frame itself, counted
// exactly, equally frequent ones by ascending pixel word; Shim et al. code differences of colours, these are
// the colours, so that any block can be read alone. Blocks, CSB and code lengths are as in HuffDCP: the two
// differ in when the dictionary is known, and at what price:
//   rendering  writes the surface raw                     1 × raw
//   stage 1    reads it to count                          1 × raw
//   stage 3    reads it again, writes it compressed       1 × raw + what every scheme moves
// The three raw passes, in whole bursts, are extra_bits: `rate` leaves them out, `rate_with_extra` has them.
#include <algorithm>

#include "color_table.h"
#include "frequent_colors.h"
#include "huffman.h"
#include "pixels/raw_bits.h"
#include "scheme_factory.h"

namespace tilepress {
namespace {

constexpr uint32_t kLengthBits = 6;
constexpr uint32_t kRawPasses = 3;

class FbcEncoder final : public BlockEncoder {
 public:
  FbcEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : entries_(spec.entries), pixel_bits_(format.pixel_bits), burst_bits_(model.burst_bits) {}

  SchemeNeeds needs() const override { return {.whole_frame = true}; }
  void begin_frame(const FrameContext& frame) override {
    std::vector<uint32_t> colors, counts;
    for (const ColorCount& entry : most_frequent_colors(frame.plane, entries_)) {
      colors.push_back(entry.color);
      counts.push_back(entry.count);
    }
    table_.assign(entries_, colors);
    code_.assign(huffman_lengths(counts));
  }
  uint32_t csb_bits() const override { return kSubBlocks; }
  uint64_t palette_bits() const override {
    return table_.table_bits(pixel_bits_) + uint64_t{table_.slots()} * kLengthBits;
  }
  void write_tables(BitWriter& out) const override {
    table_.write(pixel_bits_, out);
    for (uint32_t i = 0; i < table_.slots(); ++i)
      out.put(i < table_.colors().size() ? code_.length(i) : 0, kLengthBits);
  }
  uint32_t measure(const BlockContext& block) const override {
    if (block.uniform) return kSubBlocks * sub_block_bits(block.pixels);
    uint32_t bits = 0;
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub)
      bits += sub_block_bits(block.pixels + sub * kSubBlockPixels);
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      const uint32_t* pixels = block.pixels + sub * kSubBlockPixels;
      const bool compressed = sub_block_bits(pixels) < raw_sub_block_bits();
      csb.put(compressed, 1);
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
        if (!compressed) {
          payload.put(pixels[i], pixel_bits_);
          continue;
        }
        const uint32_t index = table_.find(pixels[i]);
        payload.put(code_.code(index), code_.length(index));
      }
    }
  }
  void account(const BlockContext&, uint32_t, SchemeStatistics& statistics) const override {
    const uint32_t raw = kBlockPixels * pixel_bits_;
    statistics.extra_bits += uint64_t{kRawPasses} * ((raw + burst_bits_ - 1) / burst_bits_) * burst_bits_;
  }

 private:
  uint32_t raw_sub_block_bits() const { return kSubBlockPixels * pixel_bits_; }
  uint32_t sub_block_bits(const uint32_t* pixels) const {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
      const uint32_t index = table_.find(pixels[i]);
      if (index == kNoColor) return raw_sub_block_bits();
      bits += code_.length(index);
    }
    return std::min(bits, raw_sub_block_bits());
  }
  const uint32_t entries_, pixel_bits_, burst_bits_;
  ColorTable table_;
  CanonicalCode code_;
};

class FbcDecoder final : public BlockDecoder {
 public:
  FbcDecoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : pixel_bits_(format.pixel_bits) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    const uint32_t slot_bits = pixel_bits_ + 1 + kLengthBits;
    code_.assign({});
    if (csb_bits != kSubBlocks || table_bits % slot_bits != 0) return false;
    const uint64_t slots = table_bits / slot_bits;
    if (!table_.read(tables, slots, pixel_bits_)) return false;
    std::vector<uint8_t> lengths;
    for (uint64_t i = 0; i < slots; ++i) {
      const auto length = static_cast<uint8_t>(tables.get(kLengthBits));
      if ((length != 0) != (i < table_.colors().size())) return false;
      if (length != 0) lengths.push_back(length);
    }
    return !tables.overran() && code_.assign(lengths);
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
      if (csb.get(1) == 0) {
        read_raw_sub_block(payload, sub, pixel_bits_, out);
        continue;
      }
      uint32_t indices[kSubBlockPixels];
      if (!code_.read_four(payload, indices)) return false;
      for (uint32_t i = 0; i < kSubBlockPixels; ++i)
        out.pixels[sub_block_pixel(sub, i)] = table_.colors()[indices[i]];
    }
    return !csb.overran() && !payload.overran();
  }

 private:
  const uint32_t pixel_bits_;
  ColorTable table_;
  CanonicalCode code_;
};

}  // namespace

const SchemeInfo kFbcInfo = {
    "fbc",
    "FBC",
    "the frame's own Huffman dictionary, built by further passes over the raw surface",
    "Shim et al. 2005, as described in Gubran et al.",
    false,
    false,
    make_encoder<FbcEncoder>,
    make_decoder<FbcDecoder>,
    true};

}  // namespace tilepress
