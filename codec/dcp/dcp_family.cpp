// DCP family decoder base: reads the rCCD that begins a frame.
#include "dcp/dcp_family.h"

namespace tilepress {

bool DcpFamilyDecoder::begin_frame(BitReader& tables, uint64_t table_bits, uint32_t csb_bits) {
  rccd_ = Rccd{};
  off_ = csb_bits == 0;
  if (off_) return table_bits == 0;
  if (csb_bits != on_csb_bits()) return false;
  if (table_bits == 0) return true;  // no CCD yet: every sub-block is marked raw
  if (table_bits % (pixel_bits_ + 1) != 0) return false;
  return rccd_.read(tables, table_bits / (pixel_bits_ + 1), pixel_bits_);
}

}  // namespace tilepress
