// Surface engine: passes the frames of one surface through the tiler, the schemes and the DRAM model.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tilepress/block_bits.h"
#include "tilepress/model_options.h"
#include "tilepress/scheme_spec.h"
#include "tilepress/statistics.h"
#include "tilepress/surface.h"

namespace tilepress {

struct CompressedSurface;

/// Holds the state of one surface: the frame before, and one FVC and one CCD per FVC configuration in use. A
/// surface is a buffer with a size and a pixel format. A buffer of another shape needs an engine of
/// its own. Not thread-safe; engines are independent of each other.
class SurfaceEngine {
 public:
  SurfaceEngine(const std::vector<SchemeSpec>& schemes, const ModelOptions& options);
  ~SurfaceEngine();
  SurfaceEngine(SurfaceEngine&&) noexcept;
  SurfaceEngine& operator=(SurfaceEngine&&) noexcept;

  /// Processes the surface's next frame. Fills width, height, format, warmup, encode_ns, metrics and schemes
  /// of `out`, and leaves the other members. Re-uses the vectors of `out`. Precondition: a modelled format,
  /// and the shape of the frames before.
  void process(const SurfaceView& frame, FrameStatistics& out);
  /// The same, and stores the frame as each scheme leaves it in memory: one surface per scheme, in order.
  void process(const SurfaceView& frame, FrameStatistics& out, std::span<CompressedSurface> surfaces);

  /// process() in steps: call begin(), then advance() until it returns false; `out` is complete then. Each
  /// step may run in another thread. The arguments of begin() must live until the last step. encode_ns sums
  /// the time of the steps.
  void begin(const SurfaceView& frame, FrameStatistics& out, std::span<CompressedSurface> surfaces = {});
  /// Processes the next row of render tiles. begin() itself does no work.
  bool advance();

  /// Also fills `bits` from the next frame on; null ends that. `bits` must outlive its use.
  void note_block_bits(BlockBits* bits);

  /// Returns the number of the next frame: the frames processed, or the last seek() and the frames since.
  uint64_t frames() const;

  /// Returns the frames that frame `ordinal` of the surface depends on, ascending. Process them in this
  /// order, each after a seek() to its number: the engine is then as if it had seen all frames before
  /// `ordinal`. That way parts of a sequence run at the same time; callers drop the figures of the repeated
  /// frames.
  std::vector<uint64_t> history(uint64_t ordinal, PixelFormat format);
  /// Makes the next frame number `ordinal` of the surface.
  void seek(uint64_t ordinal);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
