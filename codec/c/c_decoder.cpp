// C decoder: the functions tp_decoder_* of tilepress.h.
#include <memory>
#include <span>

#include "c/c_calls.h"
#include "tilepress/scheme.h"

using namespace tilepress;

struct tp_decoder {
  std::unique_ptr<BlockDecoder> decoder;
  uint32_t csb_bits = 0;
  bool has_frame = false;
};

namespace {

constexpr uint32_t kMostCsbBits = 8 * TP_CSB_BYTES;

tp_status open_decoder(uint32_t format, const char* scheme, const tp_options* options,
                       std::unique_ptr<tp_decoder>& out) {
  if (scheme == nullptr) return c_failure(TP_BAD_ARGUMENT, "scheme is NULL");
  const auto pixels = c_format(format);
  if (!pixels) return c_failure(TP_BAD_ARGUMENT, pixels.error().text);
  const auto parsed = c_options(options);
  if (!parsed) return c_failure(TP_BAD_ARGUMENT, parsed.error().text);
  const auto spec = parse_scheme(scheme, SchemeFiles::kLeave);
  if (!spec) return c_failure(TP_BAD_SCHEME, spec.error().text);
  const SchemeInfo* info = find_scheme(spec->name);
  if (!info->supports(pixels->format))
    return c_failure(TP_UNSUPPORTED, "scheme " + spec->text + " does not support the format " +
                                         std::string(traits(pixels->format).name));
  out = std::make_unique<tp_decoder>();
  out->decoder = info->make_decoder(*spec, traits(pixels->format), parsed->model);
  return TP_OK;
}

}  // namespace

tp_decoder* tp_decoder_open(uint32_t format, const char* scheme, const tp_options* options) {
  std::unique_ptr<tp_decoder> decoder;
  const tp_status status = c_call([&] { return open_decoder(format, scheme, options, decoder); });
  return status == TP_OK ? decoder.release() : nullptr;
}

void tp_decoder_close(tp_decoder* decoder) {
  delete decoder;
}

tp_status tp_decoder_begin_frame(tp_decoder* decoder, const uint8_t* tables, uint64_t table_bits,
                                 uint32_t csb_bits) {
  return c_call([&]() -> tp_status {
    if (decoder == nullptr) return c_failure(TP_BAD_ARGUMENT, "decoder is NULL");
    if (tables == nullptr && table_bits > 0) return c_failure(TP_BAD_ARGUMENT, "tables is NULL");
    decoder->has_frame = false;
    BitReader reader(std::span(tables, table_bits / 8 + (table_bits % 8 != 0)), table_bits);
    if (csb_bits > kMostCsbBits || !decoder->decoder->begin_frame(reader, table_bits, csb_bits))
      return c_failure(TP_BAD_BITS, "tables that the scheme does not write");
    decoder->csb_bits = csb_bits;
    decoder->has_frame = true;
    return TP_OK;
  });
}

tp_status tp_decoder_block(tp_decoder* decoder, uint32_t bx, uint32_t by, const uint8_t* csb,
                           const uint8_t* payload, uint32_t payload_bits, uint32_t* pixels,
                           uint32_t* used_bits) {
  return c_call([&]() -> tp_status {
    if (decoder == nullptr) return c_failure(TP_BAD_ARGUMENT, "decoder is NULL");
    if (!decoder->has_frame) return c_failure(TP_NO_FRAME, "no frame has begun");
    if (pixels == nullptr || (csb == nullptr && decoder->csb_bits > 0) ||
        (payload == nullptr && payload_bits > 0))
      return c_failure(TP_BAD_ARGUMENT, "csb, payload or pixels is NULL");
    BitReader marks({csb, (decoder->csb_bits + 7) / 8}, decoder->csb_bits);
    BitReader bits({payload, payload_bits / 8 + (payload_bits % 8 != 0)}, payload_bits);
    Block block;
    if (!decoder->decoder->decode_at(bx, by, marks, bits, block))
      return c_failure(TP_BAD_BITS, "block (" + std::to_string(bx) + ", " + std::to_string(by) +
                                        "): bits that the scheme does not write");
    std::ranges::copy(block.pixels, pixels);
    if (used_bits != nullptr) *used_bits = static_cast<uint32_t>(bits.position());
    return TP_OK;
  });
}
