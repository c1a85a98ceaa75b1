// Compressed surface: a frame as memory holds it after compression (paper §Reading a Compressed Framebuffer
// Surface, §Memory layout).
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "tilepress/block.h"
#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {

constexpr size_t kCacheLineBytes = 64;

/// Allocates whole cache lines, so that a slot touches no more lines than it fills.
template <typename T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{kCacheLineBytes};
  LineAllocator() = default;
  template <typename U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* at, size_t) { ::operator delete(at, kAlignment); }
  bool operator==(const LineAllocator&) const = default;
};

/// Blocks lie at fixed slots of S0 bytes, the size of a raw block, in raster order: block (bx, by) has number
/// by · blocks_x + bx. A block fills the first bits of its slot; the rest stays empty. CSB and tables are bit
/// strings, the most significant bit of a byte first, without gaps between blocks. SurfaceEngine::process
/// fills a surface; SurfaceReader reads it.
struct CompressedSurface {
  SchemeSpec scheme;
  PixelFormat format = PixelFormat::kRgba8;
  uint32_t width = 0, height = 0;  ///< pixels
  uint64_t ordinal = 0;            ///< 0 = first frame of the surface
  uint32_t tile_side = 32;         ///< render tile it was committed in, pixels
  uint32_t burst_bits = 128;
  uint32_t csb_bits = 0;    ///< of one block
  uint64_t table_bits = 0;  ///< rCCD or code table; 0 = none

  std::vector<uint8_t, LineAllocator<uint8_t>> payload;  ///< blocks() · slot_bytes()
  std::vector<uint8_t> csb;                              ///< ceil(blocks() · csb_bits / 8)
  std::vector<uint8_t> tables;                           ///< ceil(table_bits / 8)

  /// Payload bits of each block, which the encoder notes for files and statistics. They are not part of the
  /// memory image: the reader finds sizes from CSB and payload.
  std::vector<uint16_t> block_bits;

  /// Checks that sizes, format and model parameters are within their ranges. The functions below require
  /// that.
  Result<void> possible() const;
  /// Checks possible(), and that payload, CSB and tables have the lengths that follow.
  Result<void> consistent() const;

  uint32_t blocks_x() const { return (width + kBlockSide - 1) / kBlockSide; }
  uint32_t blocks_y() const { return (height + kBlockSide - 1) / kBlockSide; }
  uint64_t blocks() const { return uint64_t{blocks_x()} * blocks_y(); }
  uint32_t raw_block_bits() const { return kBlockPixels * traits(format).pixel_bits; }
  /// Bursts of a raw block.
  uint32_t raw_block_bursts() const { return (raw_block_bits() + burst_bits - 1) / burst_bits; }
  /// S0: a raw block in whole bursts; 256 bytes for 32-bit pixels.
  uint32_t slot_bytes() const { return raw_block_bursts() * burst_bits / 8; }
  uint64_t csb_plane_bits() const { return blocks() * csb_bits; }
};

}  // namespace tilepress
