// Surface reader: any pixel, block or rectangle of a compressed surface, with the bursts it took.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tilepress/compressed_surface.h"

namespace tilepress {

/// The reader's on-chip memory.
struct ReadOptions {
  uint32_t csb_lines = 16;       ///< lines of the CSB cache, least recently used goes first; 0 = no cache
  uint32_t csb_line_bursts = 4;  ///< bursts that one line holds, ≥ 1
};

/// What was fetched. Bursts are of the surface's burst size.
struct ReadTraffic {
  uint64_t blocks = 0;  ///< blocks fetched
  uint64_t payload_bursts = 0;
  uint64_t csb_bursts = 0;
  uint64_t table_bursts = 0;  ///< the tables are fetched once, when the reader opens
  uint64_t raw_bursts = 0;    ///< what the same blocks take in a raw surface
  uint64_t csb_lookups = 0;   ///< accesses to CSB lines; one block may touch two
  uint64_t csb_misses = 0;

  uint64_t moved_bursts() const { return payload_bursts + csb_bursts + table_bursts; }
  ReadTraffic& operator+=(const ReadTraffic& other);
};

/// Pixels [x, x + width) × [y, y + height) of a surface.
struct PixelRect {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// Decodes from payload slots, CSB plane and tables alone, in any order. Hostile surfaces give false, never
/// undefined behaviour. Not thread-safe; several readers may share one surface.
class SurfaceReader {
 public:
  SurfaceReader();
  ~SurfaceReader();
  SurfaceReader(SurfaceReader&&) noexcept;
  SurfaceReader& operator=(SurfaceReader&&) noexcept;

  /// Fetches the tables. `surface` is not owned and must outlive the reader, unchanged. False and one line in
  /// `error` if no encoder writes such a surface.
  bool open(const CompressedSurface& surface, const ReadOptions& options, std::string& error);

  /// Block of column bx and row by, its padding included. The block last read is kept: asking for it again
  /// fetches nothing. False: damaged bits, or no such block.
  bool read_block(uint32_t bx, uint32_t by, Block& out);
  /// Pixel word at (x, y). Fetches the whole block, unless it is the one kept.
  bool read_pixel(uint32_t x, uint32_t y, uint32_t& out);
  /// Pixel words of a rectangle inside the surface, row by row, tight. Each block it touches is fetched once,
  /// in raster order.
  bool read_rect(const PixelRect& rect, std::vector<uint32_t>& out);

  const ReadTraffic& traffic() const;
  /// Counts from zero again; the cache keeps what it holds.
  void reset_traffic();
  /// Payload bits of the block last read, as found from the bits themselves.
  uint32_t last_block_bits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
