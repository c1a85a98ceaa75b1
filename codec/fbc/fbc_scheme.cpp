// FBC: the frame's own Huffman dictionary, built after rendering (Shim et al. 2005, as the paper has it).
//
//   CSB, payload, tables    see dictionary/huffman_blocks.h; `entries` slots
//
// Modelling decisions. The dictionary has the `entries` most frequent colours of the frame, counted exactly;
// ties are in ascending order of the pixel word. Shim et al. code differences of colours. Here the codes are
// colours, so that any block can be read alone. FBC differs from HuffDCP in when the dictionary is known, and
// in its price:
//   rendering  writes the surface raw                     1 × raw
//   stage 1    reads it to count                          1 × raw
//   stage 3    reads it again, writes it compressed       1 × raw + what every scheme moves
// The three raw passes, in whole bursts, are extra_bits: `rate` leaves them out, `rate_with_extra` includes
// them.
#include "dictionary/entries_key.h"
#include "dictionary/frequent_colors.h"
#include "dictionary/huffman_blocks.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kRawPasses = 3;

class FbcEncoder final : public BlockEncoder {
 public:
  FbcEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions& model)
      : entries_(spec.number("entries")),
        pixel_bits_(format.pixel_bits),
        burst_bits_(model.burst_bits),
        writer_(format.pixel_bits) {}

  SchemeNeeds needs() const override { return {.whole_frame = true}; }
  void begin_frame(const FrameContext& frame) override {
    std::vector<uint32_t> colors, counts;
    for (const FrequentColor& entry : most_frequent_colors(frame.plane, entries_)) {
      colors.push_back(entry.color);
      counts.push_back(entry.count);
    }
    table_.assign(entries_, colors);
    writer_.build(counts);
  }
  uint32_t csb_bits() const override { return kSubBlocks; }
  uint64_t palette_bits() const override { return huffman_table_bits(entries_, pixel_bits_); }
  void write_tables(BitWriter& out) const override { writer_.write_tables(table_.colors(), entries_, out); }
  uint32_t measure(const BlockContext& block) const override {
    return writer_.measure(Indices(table_, block.pixels).of, block.uniform);
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    csb.put(writer_.encode(block.pixels, Indices(table_, block.pixels).of, payload), kSubBlocks);
  }
  void account(const BlockContext&, uint32_t, SchemeStatistics& statistics) const override {
    const uint32_t raw = kBlockPixels * pixel_bits_;
    statistics.extra_bits += uint64_t{kRawPasses} * ((raw + burst_bits_ - 1) / burst_bits_) * burst_bits_;
  }

 private:
  struct Indices {
    Indices(const ColorTable& table, const uint32_t* pixels) {
      for (uint32_t i = 0; i < kBlockPixels; ++i) of[i] = table.find(pixels[i]);
    }
    uint16_t of[kBlockPixels];
  };
  const uint32_t entries_, pixel_bits_, burst_bits_;
  ColorTable table_;
  HuffmanBlockWriter writer_;
};

class FbcDecoder final : public BlockDecoder {
 public:
  FbcDecoder(const SchemeSpec&, const FormatTraits& format, const ModelOptions&)
      : reader_(format.pixel_bits) {}

  bool begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) override {
    return csb_bits == kSubBlocks && table_bits != 0 && reader_.read_tables(tables, table_bits);
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    return reader_.decode(csb.get(kSubBlocks), payload, out) && !csb.overran();
  }

 private:
  HuffmanBlockReader reader_;
};

constexpr SchemeKey kKeys[] = {kEntriesKey};

}  // namespace

const SchemeInfo kFbcInfo = {
    .name = "fbc",
    .label = "FBC",
    .family = "fbc",
    .group = SchemeGroup::kLiterature,
    .summary = "the frame's own Huffman dictionary, built by further passes over the raw surface",
    .source = "Shim et al. 2005, as described in Gubran et al.",
    .make_encoder = make_encoder<FbcEncoder>,
    .make_decoder = make_decoder<FbcDecoder>,
    .keys = kKeys};

}  // namespace tilepress
