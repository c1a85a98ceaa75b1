// BPC: bit-plane compression of 128-byte lines (Kim et al. 2016).
//
//   CSB       7 bits for each 128-byte line: bytes of its payload, 0 = raw; two lines for 32-bit pixels, one
//             for 16-bit pixels
//   payload   the lines in order: the stream of bpc_line.h and zeros up to a whole byte, or 32 raw words
//   tables    none
//
// Modelling decisions. A stream ends by itself, so a decoder needs no size to find the next line. A memory
// controller needs the size, to know what to fetch. So the CSB has sizes, in bytes, for which 7 bits suffice.
// A stream of more than 127 bytes is stored raw: no line costs more than its 1024 bits. Lines take the
// block's pixels row by row, four rows of 32-bit pixels per line; `order=quad` takes them in traversal order.
// Two 16-bit pixels make a word.
#include "bpc/bpc_line.h"
#include "pixels/memory_lines.h"
#include "registry.h"

namespace tilepress {
namespace {

constexpr uint32_t kSizeBits = 7;
constexpr uint32_t kRawLineBits = kBpcWords * 32;

/// Returns the bytes of a line's stream; 0 = raw.
uint32_t line_bytes(const uint32_t* words) {
  const uint32_t bytes = (bpc_line_bits(words) + 7) / 8;
  return bytes < 1u << kSizeBits ? bytes : 0;
}

struct BpcCoder {
  BpcCoder(const SchemeSpec& spec, const FormatTraits& format)
      : order(line_order(spec)),
        pixel_bits(format.pixel_bits),
        lines(kBlockPixels * format.pixel_bits / kRawLineBits) {}
  const LineOrder order;
  const uint32_t pixel_bits;
  const uint32_t lines;  ///< of a block
};

class BpcEncoder final : public BlockEncoder {
 public:
  BpcEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : coder_(spec, format) {}

  uint32_t csb_bits() const override { return coder_.lines * kSizeBits; }
  uint32_t measure(const BlockContext& block) const override {
    const LineWords lines = to_line_words(block.raster(), coder_.order, coder_.pixel_bits);
    if (block.uniform) return coder_.lines * line_bits(lines.words.data());
    uint32_t bits = 0;
    for (uint32_t i = 0; i < lines.count; i += kBpcWords) bits += line_bits(&lines.words[i]);
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const LineWords lines = to_line_words(block.raster(), coder_.order, coder_.pixel_bits);
    for (uint32_t i = 0; i < lines.count; i += kBpcWords) {
      const uint32_t bytes = line_bytes(&lines.words[i]);
      csb.put(bytes, kSizeBits);
      if (bytes == 0) {
        for (uint32_t word = 0; word < kBpcWords; ++word) payload.put(lines.words[i + word], 32);
        continue;
      }
      const uint64_t end = payload.bit_count() + uint64_t{bytes} * 8;
      bpc_line_write(&lines.words[i], payload);
      payload.pad_to(end);
    }
  }

 private:
  static uint32_t line_bits(const uint32_t* words) {
    const uint32_t bytes = line_bytes(words);
    return bytes == 0 ? kRawLineBits : bytes * 8;
  }
  const BpcCoder coder_;
};

class BpcDecoder final : public BlockDecoder {
 public:
  BpcDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : coder_(spec, format) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == coder_.lines * kSizeBits;
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    LineWords lines;
    lines.count = coder_.lines * kBpcWords;
    for (uint32_t i = 0; i < lines.count; i += kBpcWords) {
      const auto bytes = static_cast<uint32_t>(csb.get(kSizeBits));
      if (bytes == 0) {
        for (uint32_t word = 0; word < kBpcWords; ++word)
          lines.words[i + word] = static_cast<uint32_t>(payload.get(32));
        continue;
      }
      const uint64_t end = payload.position() + uint64_t{bytes} * 8;
      if (!bpc_line_read(payload, &lines.words[i]) || payload.position() > end) return false;
      payload.skip(end - payload.position());
    }
    from_line_words(lines, coder_.order, coder_.pixel_bits, out);
    return !csb.overran() && !payload.overran();
  }

 private:
  const BpcCoder coder_;
};

}  // namespace

const SchemeInfo kBpcInfo = {.name = "bpc",
                             .label = "BPC",
                             .family = "lines",
                             .summary = "bit-plane compression of 128-byte lines of the block",
                             .source = "Kim et al. 2016",
                             .make_encoder = make_encoder<BpcEncoder>,
                             .make_decoder = make_decoder<BpcDecoder>,
                             .keys = kOrderKey};

}  // namespace tilepress
