// A simulator's use of the installed codec: feeds frames, gets bits, reads blocks back. Exit status 0 if all
// is as it should be.
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "tilepress/bit_io.h"
#include "tilepress/color_cdf.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/cost_model.h"
#include "tilepress/scheme.h"
#include "tilepress/surface_engine.h"
#include "tilepress/surface_reader.h"

namespace {

constexpr uint32_t kWidth = 100, kHeight = 60;

std::vector<uint32_t> draw(uint32_t frame) {
  std::vector<uint32_t> words(kWidth * kHeight, 0xFF204060);
  for (uint32_t i = 0; i < words.size(); ++i)
    if (i % 97 < 20) words[i] = 0xFF000000 | (i % 7 + frame) * 0x010203;
  return words;
}

int fail(const char* what) {
  std::fprintf(stderr, "simulator: %s\n", what);
  return 1;
}

}  // namespace

int main() {
  using namespace tilepress;
  std::vector<SchemeSpec> schemes;
  for (const char* text : {"vdcp", "hdcp:fvc=16", "ras"}) {
    const auto scheme = parse_scheme(text);
    if (!scheme) return fail(scheme.error().text.c_str());
    schemes.push_back(*scheme);
  }
  SurfaceEngine engine(schemes, ModelOptions{});
  FrameStatistics statistics;
  std::vector<CompressedSurface> surfaces(schemes.size());
  std::vector<uint32_t> words;
  for (uint32_t frame = 0; frame < 3; ++frame) {
    words = draw(frame);
    const SurfaceView view{reinterpret_cast<const std::byte*>(words.data()),
                           kWidth * 4,
                           kWidth,
                           kHeight,
                           PixelFormat::kRgba8,
                           ByteOrder::kRgba};
    engine.process(view, statistics, surfaces);
  }
  for (size_t i = 0; i < schemes.size(); ++i) {
    SurfaceReader reader;
    if (const auto opened = reader.open(surfaces[i], ReadOptions{}); !opened)
      return fail(opened.error().text.c_str());
    Block block;
    if (!reader.read_block(5, 3, block)) return fail("block (5, 3) does not decode");
    for (uint32_t y = 0; y < 8; ++y)
      for (uint32_t x = 0; x < 8; ++x)
        if (block.pixels[8 * y + x] != words[(24 + y) * kWidth + 40 + x]) return fail("a pixel differs");

    // The block's own bits, through the decoder that the registry gives.
    const SchemeInfo* info = find_scheme(schemes[i].name);
    const auto decoder = info->make_decoder(schemes[i], traits(PixelFormat::kRgba8), ModelOptions{});
    const CompressedSurface& surface = surfaces[i];
    BitReader tables(surface.tables, surface.table_bits);
    if (!decoder->begin_frame(tables, surface.table_bits, surface.csb_bits)) return fail("tables refused");
    const uint64_t number = 3 * surface.blocks_x() + 5;
    BitReader csb(surface.csb);
    csb.skip(number * surface.csb_bits);
    BitReader payload(
        std::span(surface.payload).subspan(number * surface.slot_bytes(), surface.slot_bytes()));
    Block again;
    if (!decoder->decode(csb, payload, again) || !(again == block)) return fail("decoder and reader differ");
    if (payload.position() != surface.block_bits[number]) return fail("a block of another size than written");
    std::printf("%s: rate %.3f, saves %.1f %% of the energy\n", schemes[i].text.c_str(),
                statistics.schemes[i].rate(), 100 * energy_saving(statistics.schemes[i].rate()));
  }
  return 0;
}
