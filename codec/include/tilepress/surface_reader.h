// Surface reader: returns any pixel, block or rectangle of a compressed surface, and counts bursts.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tilepress/compressed_surface.h"

namespace tilepress {

/// The on-chip memory of the reader.
struct ReadOptions {
  uint32_t csb_lines = 16;       ///< lines of the CSB cache, least recently used leaves first; 0 = no cache
  uint32_t csb_line_bursts = 4;  ///< bursts per line, ≥ 1
};

/// What the reader fetched, in bursts of the surface's burst size.
struct ReadTraffic {
  uint64_t blocks = 0;  ///< blocks fetched
  uint64_t payload_bursts = 0;
  uint64_t csb_bursts = 0;
  uint64_t table_bursts = 0;  ///< the tables are fetched once, when the reader opens
  uint64_t raw_bursts = 0;    ///< of the same blocks in a raw surface
  uint64_t csb_lookups = 0;   ///< accesses to CSB lines; a block may touch two
  uint64_t csb_misses = 0;

  uint64_t moved_bursts() const { return payload_bursts + csb_bursts + table_bursts; }
  ReadTraffic& operator+=(const ReadTraffic& other);
};

/// The parts of a surface in memory, one after another.
enum class SurfacePart : uint8_t { kPayload, kCsb, kTables };

/// One access of the reader to memory: neighbouring bursts.
struct MemoryFetch {
  SurfacePart part;
  uint64_t offset_bytes;  ///< in that part; of payload from the first slot
  uint64_t bursts;        ///< 0: a block that fills none
};

/// Pixels [x, x + width) × [y, y + height) of a surface.
struct PixelRect {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// Decodes from payload slots, CSB plane and tables alone, in any order. Returns false for hostile surfaces,
/// never undefined behaviour. Not thread-safe; several readers may share one surface.
class SurfaceReader {
 public:
  SurfaceReader();
  ~SurfaceReader();
  SurfaceReader(SurfaceReader&&) noexcept;
  SurfaceReader& operator=(SurfaceReader&&) noexcept;

  /// Fetches the tables. `surface` is not owned and must outlive the reader, unchanged. Returns an error if
  /// no encoder writes such a surface.
  Result<void> open(const CompressedSurface& surface, const ReadOptions& options);

  /// Reads the block of column bx and row by, padding included. The block last read is kept, so that a second
  /// read fetches nothing. Returns false for damaged bits or if there is no such block.
  bool read_block(uint32_t bx, uint32_t by, Block& out);
  /// Reads the pixel word at (x, y). Fetches the whole block unless it is the block kept.
  bool read_pixel(uint32_t x, uint32_t y, uint32_t& out);
  /// Reads the pixel words of a rectangle inside the surface, row by row without gaps. Fetches each block of
  /// the rectangle once, in raster order.
  bool read_rect(const PixelRect& rect, std::vector<uint32_t>& out);

  /// Also appends each access to `fetches`, from the next open() on; null ends that. `fetches` must outlive its
  /// use.
  void note_fetches(std::vector<MemoryFetch>* fetches);

  const ReadTraffic& traffic() const;
  /// Sets the counts to zero. The cache keeps its lines.
  void reset_traffic();
  /// Returns the payload bits of the block last read, as decoded.
  uint32_t last_block_bits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
