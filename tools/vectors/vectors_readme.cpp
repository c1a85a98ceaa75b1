// Vectors' README: layout, order and widths.
#include "vectors/vectors_readme.h"

#include <fmt/format.h>

#include <algorithm>

#include "counted.h"
#include "tilepress/scheme.h"
#include "vectors/block_lines.h"

namespace tilepress {
namespace {

constexpr char kHead[] = R"(# Vectors of {}

`tilepress vectors` wrote {} of {}x{} pixels, {}, {} a frame.
Scheme: {}.
The bits are those of the encoder, and every block came back from them. The FVC is the plain definition.

Each folder `frame-NNNNNN` holds one frame of the input. `frame.vh` in it has the numbers of the frame as
Verilog parameters: BLOCKS, CSB_BITS and so on.

)";

constexpr const char* kOrder = R"(## Order

- Every file has one number a line, in hexadecimal, for `$readmemh`.
- Blocks are in the order of commitment: render tiles in raster order, in a tile the blocks in raster order. Line n of
  each file with a line per block belongs to the same block.
- The pixels of a block are in scan order: 2x2 sub-blocks in raster order, in a sub-block the pixels in raster order.
  The encoder and the FVC take the pixels in this order. Pixel n of the scan lies here in the block:

)";

constexpr const char* kBits = R"(
- Bit strings (csb, payload, tables, mask) begin at the highest bit of their line. Fields follow each other without
  gaps, the highest bit of a field first.
- A payload fills the first `payload_bits` bits of its line. The rest is 0.
- Blocks at the right and lower border are padded with the nearest pixel inside the surface. Padding is compressed. It
  never enters the FVC: `mask` has a 1 for each pixel that does.

codec/README.md of the sources, *The formats*, draws payload, CSB and tables of each scheme.
)";

constexpr const char* kFvc = R"(
## FVC and CCD

The CCD of a frame holds the colours of an earlier frame, the most frequent first: sort the valid slots of
`fvc_before_frame` by count, descending, ties by slot, ascending. Entry 0 has index 0.

The FVC is emptied when a frame that it collects begins (`FVC_COLLECTS` in frame.vh). To test one: load
`fvc_before_blocks`, feed the pixels of all blocks in their order without padding, and compare with `fvc_after_blocks`.
Colour and count of an empty slot are 0.
)";

constexpr char kExample[] = R"(
## A first look

    // look.v
    module look;
      `include "frame.vh"
      reg [PIXEL_BITS-1:0] pixels [0:64*BLOCKS-1];
      reg [15:0] payload_bits [0:BLOCKS-1];
      integer n, sum;
      initial begin
        $readmemh("{0}/pixels.hex", pixels);
        $readmemh("{0}/payload_bits.hex", payload_bits);
        sum = 0;
        for (n = 0; n < BLOCKS; n = n + 1) sum = sum + payload_bits[n];
        $display("%0d blocks, %0d payload bits, first pixel %h", BLOCKS, sum, pixels[0]);
      end
    endmodule

    iverilog -g2005 -I {0} -o look look.v && vvp look
)";

std::string scan_table() {
  std::array<uint32_t, kBlockPixels> scan{};
  for (uint32_t i = 0; i < kBlockPixels; ++i) scan[kTraversal[i]] = i;
  std::string out;
  for (uint32_t at = 0; at < kBlockPixels; ++at)
    out += fmt::format("{}{:>3}{}", at % 8 == 0 ? "      " : "", scan[at], at % 8 == 7 ? "\n" : "");
  return out;
}

std::string row(const char* file, const std::string& lines, uint64_t bits, const std::string& meaning) {
  return fmt::format("| `{}` | {} | {} | {} |\n", file, lines, bits, meaning);
}

/// The table of files. Files that only some frames have are listed with their condition.
std::string file_table(const VectorFrame& any, uint64_t table_bits) {
  std::string out =
      "| file | lines | bits | a line |\n"
      "|---|---|---|---|\n";
  out += row("places.hex", "BLOCKS", 32, "{row 16, column 16} of the block in the surface, in blocks");
  out += row(
      "pixels.hex", "64 BLOCKS", any.pixel_bits,
      "a pixel in scan order: " +
          std::string(any.pixel_bits == 32 ? "the memory bytes, the first byte lowest (RGBA8: {A, B, G, R})"
                                           : "the memory bytes, the first byte lowest"));
  out += row("mask.hex", "BLOCKS", 64, "1 = pixel of the surface, 0 = padding; the first pixel highest");
  out += row("csb.hex", "BLOCKS", any.csb_bits, "compression status bits; no file in frames with CSB_BITS 0");
  out += row("payload.hex", "BLOCKS", any.payload_width, "payload, filled up with 0");
  out += row("payload_bits.hex", "BLOCKS", 16, "bits of the payload");
  if (table_bits > 0)
    out += row("tables.hex", "TABLE_BITS / 8, rounded up", 8,
               "the tables that go with the frame, byte by byte; no file in frames with TABLE_BITS 0");
  if (any.fvc_entries == 0) return out;
  const std::string entries = std::to_string(any.fvc_entries);
  const uint64_t slot_bits = 1 + any.pixel_bits + kCountBits;
  const std::string slot = fmt::format("{{valid 1, colour {}, count {}}}", any.pixel_bits, kCountBits);
  out += row("ccd.hex", entries, 1 + any.pixel_bits,
             fmt::format("{{valid 1, colour {}}}: the CCD that serves this frame", any.pixel_bits));
  out += row("fvc_before_frame.hex", entries, slot_bits,
             slot + " by slot: before the frame, as the FVC was left");
  out += row("fvc_before_blocks.hex", entries, slot_bits, "the same, before the first of these blocks");
  out += row("fvc_after_blocks.hex", entries, slot_bits, "the same, after the last of these blocks");
  out += row("fvc_after_frame.hex", entries, slot_bits, "the same, after the frame");
  if (any.fvc_has_last)
    out += row("fvc_*_last.hex", entries, kCountBits,
               "the sample, from 1, that hit or filled the slot last; `lru` evicts the least");
  return out;
}

std::string example(const VectorFrame& frame) {
  return fmt::format(kExample, vector_folder(frame.frame));
}

}  // namespace

std::string vector_folder(uint64_t frame) {
  return fmt::format("frame-{:06}", frame);
}

std::string vectors_readme(const std::vector<VectorFrame>& frames, const CompressedSurface& surface) {
  // The widest of all: a frame without CCD, or one that is switched off, has less.
  VectorFrame any = frames.front();
  uint64_t table_bits = 0;
  for (const VectorFrame& frame : frames) {
    any.csb_bits = std::max(any.csb_bits, frame.csb_bits);
    table_bits = std::max(table_bits, frame.table_bits);
  }
  const SchemeInfo& info = *find_scheme(surface.scheme.name);
  std::string out =
      fmt::format(kHead, surface.scheme.text, counted(frames.size(), "frame"), surface.width, surface.height,
                  traits(surface.format).name, counted(any.blocks, "block"), info.summary);
  out += file_table(any, table_bits) + "\n" + kOrder + scan_table() + kBits;
  if (any.fvc_entries != 0) out += kFvc;
  return out + example(frames.back());
}

}  // namespace tilepress
