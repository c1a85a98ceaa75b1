// Sized lines: the encoder and the decoder of schemes that code a block as memory lines, each line alone,
// with the size of each line in the CSB.
//
//   CSB       7 bits for each line: bytes of its payload, 0 = raw
//   payload   the lines in order: the line's stream and zeros up to a whole byte, or its raw words
//   tables    none
//
// A stream ends by itself, so a decoder needs no size to find the next line. A memory controller needs the
// size, to know what to fetch.
#pragma once

#include "pixels/memory_lines.h"

namespace tilepress {

/// What a `Line` type must have:
///   kWords      32-bit words of a line
///   kMostBytes  a longer stream is stored raw, at most 127
///   bits(words) bits of the stream of kWords words
///   write(words, out), read(in, words)   the stream; read() returns false for bits that write() never writes
template <class Line>
struct SizedLines {
  SizedLines(const SchemeSpec& spec, const FormatTraits& format)
      : order(line_order(spec)),
        pixel_bits(format.pixel_bits),
        count(kBlockPixels * format.pixel_bits / kRawBits) {}
  static constexpr uint32_t kSizeBits = 7;
  static constexpr uint32_t kRawBits = Line::kWords * 32;
  static_assert(Line::kMostBytes < 1u << kSizeBits && Line::kMostBytes * 8 < kRawBits);

  /// Returns the bytes of a line's stream; 0 = raw.
  static uint32_t bytes_of(const uint32_t* words) {
    const uint32_t bytes = (Line::bits(words) + 7) / 8;
    return bytes <= Line::kMostBytes ? bytes : 0;
  }
  static uint32_t bits_of(const uint32_t* words) {
    const uint32_t bytes = bytes_of(words);
    return bytes == 0 ? kRawBits : bytes * 8;
  }
  uint32_t csb_bits() const { return count * kSizeBits; }
  LineWords words_of(const BlockContext& block) const {
    return to_line_words(block.raster(), order, pixel_bits);
  }

  const LineOrder order;
  const uint32_t pixel_bits;
  const uint32_t count;  ///< lines of a block
};

template <class Line>
class SizedLineEncoder final : public BlockEncoder {
 public:
  SizedLineEncoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : lines_(spec, format) {}

  uint32_t csb_bits() const override { return lines_.csb_bits(); }
  uint32_t measure(const BlockContext& block) const override {
    const LineWords lines = lines_.words_of(block);
    if (block.uniform) return lines_.count * lines_.bits_of(lines.words.data());
    uint32_t bits = 0;
    for (uint32_t i = 0; i < lines.count; i += Line::kWords) bits += lines_.bits_of(&lines.words[i]);
    return bits;
  }
  void encode(const BlockContext& block, BitWriter& payload, BitWriter& csb) const override {
    const LineWords lines = lines_.words_of(block);
    for (uint32_t i = 0; i < lines.count; i += Line::kWords) {
      const uint32_t bytes = lines_.bytes_of(&lines.words[i]);
      csb.put(bytes, lines_.kSizeBits);
      if (bytes == 0) {
        for (uint32_t word = 0; word < Line::kWords; ++word) payload.put(lines.words[i + word], 32);
        continue;
      }
      const uint64_t end = payload.bit_count() + uint64_t{bytes} * 8;
      Line::write(&lines.words[i], payload);
      payload.pad_to(end);
    }
  }

 private:
  const SizedLines<Line> lines_;
};

template <class Line>
class SizedLineDecoder final : public BlockDecoder {
 public:
  SizedLineDecoder(const SchemeSpec& spec, const FormatTraits& format, const ModelOptions&)
      : lines_(spec, format) {}

  bool begin_frame(BitReader&, uint64_t table_bits, uint32_t csb_bits) override {
    return table_bits == 0 && csb_bits == lines_.csb_bits();
  }
  bool decode(BitReader& csb, BitReader& payload, Block& out) const override {
    LineWords lines;
    lines.count = lines_.count * Line::kWords;
    for (uint32_t i = 0; i < lines.count; i += Line::kWords) {
      const auto bytes = static_cast<uint32_t>(csb.get(lines_.kSizeBits));
      if (bytes == 0) {
        for (uint32_t word = 0; word < Line::kWords; ++word)
          lines.words[i + word] = static_cast<uint32_t>(payload.get(32));
        continue;
      }
      const uint64_t end = payload.position() + uint64_t{bytes} * 8;
      if (!Line::read(payload, &lines.words[i]) || payload.position() > end) return false;
      payload.skip(end - payload.position());
    }
    from_line_words(lines, lines_.order, lines_.pixel_bits, out);
    return !csb.overran() && !payload.overran();
  }

 private:
  const SizedLines<Line> lines_;
};

}  // namespace tilepress
