// BPC: bit-plane compression of 128-byte lines (Kim et al. 2016).
//
//   CSB, payload, tables    see pixels/sized_lines.h; two lines for 32-bit pixels, one for 16-bit pixels; the
//                           stream of bpc_line.h
//
// Modelling decisions. The CSB has sizes in bytes, for which 7 bits suffice. A stream of more than 127 bytes
// is stored raw: no line costs more than its 1024 bits. Lines take the block's pixels row by row, four rows
// of 32-bit pixels per line; `order=quad` takes them in traversal order. Two 16-bit pixels make a word.
#include "bpc/bpc_line.h"
#include "pixels/sized_lines.h"
#include "registry.h"

namespace tilepress {
namespace {

struct BpcLine {
  static constexpr uint32_t kWords = kBpcWords, kMostBytes = 127;
  static uint32_t bits(const uint32_t* words) { return bpc_line_bits(words); }
  static void write(const uint32_t* words, BitWriter& out) { bpc_line_write(words, out); }
  static bool read(BitReader& in, uint32_t* words) { return bpc_line_read(in, words); }
};

}  // namespace

const SchemeInfo kBpcInfo = {.name = "bpc",
                             .label = "BPC",
                             .family = "lines",
                             .group = SchemeGroup::kLiterature,
                             .summary = "bit-plane compression of 128-byte lines of the block",
                             .source = "Kim et al. 2016",
                             .make_encoder = make_encoder<SizedLineEncoder<BpcLine>>,
                             .make_decoder = make_decoder<SizedLineDecoder<BpcLine>>,
                             .keys = kOrderKey};

}  // namespace tilepress
