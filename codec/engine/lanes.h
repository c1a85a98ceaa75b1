// Lanes: one per scheme; each measures, stores, checks and accounts every block.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "engine/block_check.h"
#include "engine/block_runs.h"
#include "memory/surface_store.h"
#include "tilepress/block_bits.h"
#include "tilepress/scheme.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Lanes {
 public:
  /// Makes the encoders of the schemes that support `format`, which subscribe to `analyses`; and the
  /// decoders, if blocks are verified.
  void open(std::span<const SchemeSpec> specs, PixelFormat format, const ModelOptions& options,
            SharedAnalyses& analyses);
  /// A need is set if one scheme has it. Valid after open().
  const SchemeNeeds& needs() const { return needs_; }

  /// `surfaces` are where the frame is stored; empty if it is not. `block_bits` may be null.
  void begin_frame(const FrameContext& frame, std::span<CompressedSurface> surfaces, BlockBits* block_bits,
                   std::vector<SchemeStatistics>& out);
  /// Takes a block. The figures of a block of one colour are kept at `place`.
  void take(const BlockContext& block, uint32_t place);
  /// Takes `count` blocks side by side that repeat the block kept at `place`. Their figures count at
  /// settle().
  void take_repeats(uint32_t place, uint32_t bx, uint32_t count, uint32_t by);
  /// Adds the figures of `repeats` blocks like the block kept at `place`.
  void settle(uint32_t place, uint64_t repeats);
  /// After the last block and the frame metrics.
  void end_frame();

 private:
  struct Lane {
    SchemeSpec spec;
    size_t index;  ///< among all schemes: those that do not support the format have no lane
    std::unique_ptr<BlockEncoder> encoder;
    std::unique_ptr<BlockDecoder> decoder{};  ///< only with verify
    uint32_t csb_bits = 0;
    SurfaceStore store{};
    std::array<SchemeStatistics, BlockRuns::kPlaces> solids{};  ///< what the block kept at each place adds
  };
  void begin_lane(Lane& lane, const FrameContext& frame, CompressedSurface* surface, SchemeStatistics& out);
  void check_block(Lane& lane, const BlockContext& block, uint32_t payload_bits, SchemeStatistics& added);

  std::vector<Lane> lanes_;
  std::vector<bool> skipped_;  ///< by scheme
  SchemeNeeds needs_;
  ModelOptions options_;
  BlockCheck check_;
  uint32_t burst_shift_ = 0;  ///< burst_bits is a power of two
  uint64_t blocks_ = 0;       ///< of the frame
  uint32_t raw_block_bits_ = 0;
  bool stores_ = false;
  BlockBits* block_bits_ = nullptr;
  std::vector<SchemeStatistics>* out_ = nullptr;
};

}  // namespace tilepress
