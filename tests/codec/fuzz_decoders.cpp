// Fuzz target for the block decoders: any tables, CSB and payload give a block or a refusal.
//
// Input: scheme, format, log2 of the burst bytes, CSB bits a block, table bits (two bytes, low first), the
// tables, bytes of CSB, the CSB, the payload (all that is left). CSB bits of 255 stand for what the scheme
// itself uses.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>

#include "scheme_texts.h"
#include "tilepress/scheme.h"

namespace {

using namespace tilepress;

/// Takes bytes off the front; zeros once nothing is left.
class Input {
 public:
  explicit Input(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  uint32_t byte() {
    const auto one = take(1);
    return one.empty() ? 0 : one[0];
  }
  std::span<const uint8_t> take(size_t count) {
    const auto front = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(front.size());
    return front;
  }
  std::span<const uint8_t> rest() { return take(bytes_.size()); }

 private:
  std::span<const uint8_t> bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  Input input({bytes, size});
  const auto spec = parse_scheme(harness::kSchemeTexts[input.byte() % std::size(harness::kSchemeTexts)]);
  if (!spec) __builtin_trap();
  constexpr PixelFormat kFormats[] = {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565,
                                      PixelFormat::kRgb10a2};
  const PixelFormat pixel_format = kFormats[input.byte() % std::size(kFormats)];
  const FormatTraits& format = traits(pixel_format);
  ModelOptions model;
  model.burst_bits = 16u << input.byte() % 8;
  const SchemeInfo* info = find_scheme(spec->name);
  if (!info->supports(pixel_format)) return 0;
  const auto decoder = info->make_decoder(*spec, format, model);
  uint32_t csb_bits = input.byte();
  if (csb_bits == 255) csb_bits = info->make_encoder(*spec, format, model)->csb_bits();
  const uint32_t table_low = input.byte(), table_bits = table_low | input.byte() << 8;
  BitReader tables(input.take((table_bits + 7) / 8), table_bits);
  if (!decoder->begin_frame(tables, table_bits, csb_bits)) return 0;
  if (tables.overran()) __builtin_trap();
  BitReader csb(input.take(input.byte())), payload(input.rest());
  for (int block = 0; block < 4; ++block) {
    Block out{};
    if (!decoder->decode(csb, payload, out)) return 0;
    if (csb.overran() || payload.overran()) __builtin_trap();
    for (const uint32_t word : out.pixels)
      if (uint64_t{word} >> format.pixel_bits != 0) __builtin_trap();
  }
  return 0;
}
