// RAS block: a stream padded to its size class, or raw pixels; RAS and HDCP share it.
#pragma once

#include "memory/size_classes.h"
#include "pixels/raw_bits.h"
#include "ras/ras_stream.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Appends classes.bits_of(cls) payload bits. `cls` is the class of the block's stream.
inline void ras_block_write(const BlockContext& block, uint32_t cls, const SizeClasses& classes,
                            const FormatTraits& format, bool ycocg, BitWriter& payload) {
  if (cls == classes.raw_class()) return write_raw_block(block.pixels, format.pixel_bits, payload);
  const uint64_t end = payload.bit_count() + classes.bits_of(cls);
  ras_stream_write(block.raster(), format, ycocg, payload);
  payload.pad_to(end);
}

/// Reads a block of the class that the CSB names. Returns false if there is no such class or no encoder
/// writes the bits.
inline bool ras_block_read(BitReader& payload, uint32_t cls, const SizeClasses& classes,
                           const FormatTraits& format, bool ycocg, Block& out) {
  if (!classes.valid(cls)) return false;
  if (cls == classes.raw_class()) {
    read_raw_block(payload, format.pixel_bits, out);
    return !payload.overran();
  }
  const uint64_t end = payload.position() + classes.bits_of(cls);
  if (!ras_stream_read(payload, format, ycocg, out) || payload.position() > end) return false;
  payload.skip(end - payload.position());
  return !payload.overran();
}

}  // namespace tilepress
