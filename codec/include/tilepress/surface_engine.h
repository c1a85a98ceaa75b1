// Surface engine: feeds the frames of one surface through the tiler, the schemes and the DRAM model.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tilepress/scheme_spec.h"
#include "tilepress/statistics.h"
#include "tilepress/surface.h"

namespace tilepress {

struct CompressedSurface;

/// The modelled hardware.
struct ModelOptions {
  uint32_t tile_side = 32;    ///< render tile, pixels; a multiple of 8, 8..4096
  uint32_t burst_bits = 128;  ///< DRAM transfer unit; a power of two, 16..2048
  bool verify = false;        ///< encode, decode and compare every block of every frame
  bool frame_metrics = true;  ///< off: FrameStatistics::metrics stays zero
};

/// Payload bits of each block of a frame, what a heat map shows.
struct BlockBits {
  uint32_t blocks_x = 0, blocks_y = 0;
  uint32_t raw_bits = 0;                       ///< of a block that is not compressed
  std::vector<std::vector<uint16_t>> schemes;  ///< in their order; blocks in raster order
};

/// State of one surface: the frame before, and one FVC and one CCD per FVC configuration in use.
/// A surface is a buffer with a size and a pixel format (spec §1): a buffer of another shape is another
/// surface and needs an engine of its own. Not thread-safe; engines are independent of each other.
class SurfaceEngine {
 public:
  SurfaceEngine(const std::vector<SchemeSpec>& schemes, const ModelOptions& options);
  ~SurfaceEngine();
  SurfaceEngine(SurfaceEngine&&) noexcept;
  SurfaceEngine& operator=(SurfaceEngine&&) noexcept;

  /// Processes the surface's next frame. Fills width, height, format, warmup, encode_ns, metrics and schemes
  /// of `out`; leaves frame, surface, time_ns and readback_ns as they are. The vectors of `out` are re-used.
  /// Precondition: a modelled format, and the shape of the frames before.
  void process(const SurfaceView& frame, FrameStatistics& out);
  /// The same, and stores the frame as each scheme leaves it in memory: one surface per scheme, in their
  /// order.
  void process(const SurfaceView& frame, FrameStatistics& out, std::span<CompressedSurface> surfaces);

  /// process() in steps, between which the caller may do other things, or go on in another thread: begin(),
  /// then advance() until it returns false, when `out` is complete. Until then what was passed to begin()
  /// must live. encode_ns is the time spent in the steps.
  void begin(const SurfaceView& frame, FrameStatistics& out, std::span<CompressedSurface> surfaces = {});
  /// Takes the next row of render tiles. begin() itself does no work.
  bool advance();

  /// From the next frame on also fills `bits`, which must outlive it; null ends that.
  void note_block_bits(BlockBits* bits);

  /// Number of frames processed, or the last seek() and the frames since.
  uint64_t frames() const;

  /// The frames that frame `ordinal` of the surface depends on, ascending: processed in this order, each
  /// after a seek() to its number, they leave an engine as if it had seen all frames before `ordinal`. This
  /// is how a sequence is cut into parts that run at once; what the repeated frames give is thrown away.
  std::vector<uint64_t> history(uint64_t ordinal, PixelFormat format);
  /// The next frame is number `ordinal` of the surface.
  void seek(uint64_t ordinal);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
