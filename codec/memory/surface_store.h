// Surface store: the encoder's side of a compressed surface; puts blocks into their slots.
#pragma once

#include <array>
#include <span>

#include "solid_blocks.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Writes one frame into a surface. Blocks may come in any order, each once.
class SurfaceStore {
 public:
  /// After encoder.begin_frame(). `out` is not owned; its buffers are re-used.
  void begin_frame(const SchemeSpec& spec, const ModelOptions& options, const FrameContext& frame,
                   const BlockEncoder& encoder, CompressedSurface& out);
  /// Returns the block's payload bits.
  uint32_t put(const BlockEncoder& encoder, const BlockContext& block);
  /// Keeps the block put last, to be put again, until the frame ends or another is kept there.
  void keep(uint32_t place) { kept_[place] = last_; }
  /// The block kept there, as blocks `bx` to `bx_end` of row `by`.
  void put_again(uint32_t place, uint32_t bx, uint32_t bx_end, uint32_t by);

 private:
  static constexpr uint32_t kMaxCsbBytes = 32;
  struct Put {
    uint64_t number = 0;                      ///< of the block
    std::array<uint8_t, kMaxCsbBytes> csb{};  ///< its bits
  };
  void put_csb(const Put& put, uint64_t first, uint32_t count);
  uint8_t* payload_ = nullptr;  ///< of the surface, as what follows
  uint16_t* block_bits_ = nullptr;
  std::span<uint8_t> csb_;
  uint32_t csb_bits_ = 0;               ///< of a block
  uint64_t blocks_ = 0, blocks_x_ = 0;  ///< of the surface; slot_bytes_ too: divisions otherwise made anew
  size_t slot_bytes_ = 0;
  Put last_;
  std::array<Put, SolidBlocks::kPlaces> kept_;
};

}  // namespace tilepress
