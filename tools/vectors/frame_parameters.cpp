// Frame parameters: a localparam per number.
#include "vectors/frame_parameters.h"

#include <fmt/format.h>

#include <bit>

namespace tilepress {
namespace {

std::string number(const char* name, uint64_t value, const char* meaning) {
  return fmt::format("localparam integer {:<18} = {};  // {}\n", name, value, meaning);
}

std::string state_numbers(const std::string& when, const FvcState& state) {
  return fmt::format(
      "localparam [31:0] SAMPLES_{0} = 32'd{1};\n"
      "localparam [31:0] UNTIL_SAMPLE_{0} = 32'd{2};\n"
      "localparam [31:0] RANDOM_{0} = 32'h{3:08x};\n",
      when, state.samples, state.until_sample, state.random);
}

}  // namespace

std::string parameters_text(const VectorFrame& frame, const CompressedSurface& surface,
                            const FvcPair& states) {
  std::string out =
      fmt::format("// Frame {} of the input, {}x{} {}, scheme {}. Include it inside a module.\n", frame.frame,
                  surface.width, surface.height, traits(surface.format).name, surface.scheme.text);
  out += number("FRAME", frame.frame, "number of the input frame");
  out += number("ORDINAL", frame.ordinal, "number of the modelled frame; 0 has no CCD");
  out += number("WIDTH", surface.width, "pixels of the surface");
  out += number("HEIGHT", surface.height, "pixels of the surface");
  out += number("TILE", surface.tile_side, "side of a render tile, pixels");
  out += number("FIRST_BLOCK", frame.first, "number of the first block, in the order of the lines");
  out += number("BLOCKS", frame.blocks, "blocks in these files");
  out += number("PIXEL_BITS", frame.pixel_bits, "bits of a pixel");
  out += number("PAYLOAD_WIDTH", frame.payload_width, "bits of a line of payload.hex: a raw block");
  out += number("CSB_BITS", frame.csb_bits, "bits of a line of csb.hex; 0: no file");
  out += number("TABLE_BITS", frame.table_bits, "bits in tables.hex; 0: no file");
  if (frame.fvc_entries == 0) return out;
  out += number("ENTRIES", frame.fvc_entries, "slots of the FVC, entries of the CCD");
  out +=
      number("INDEX_BITS", static_cast<uint64_t>(std::bit_width(frame.fvc_entries) - 1), "log2 of ENTRIES");
  out += number("CCD_COLORS", frame.ccd_colors, "valid entries of ccd.hex");
  out += number("FVC_COLLECTS", frame.fvc_collects, "1: the FVC collects in this frame");
  out += "// Registers beside the slots of fvc_before_blocks.hex and fvc_after_blocks.hex.\n";
  return out + state_numbers("BEFORE_BLOCKS", states.before_blocks) +
         state_numbers("AFTER_BLOCKS", states.after_blocks);
}

}  // namespace tilepress
