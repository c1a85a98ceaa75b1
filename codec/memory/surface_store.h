// Surface store: the encoder's side of a compressed surface; writes blocks into their slots.
#pragma once

#include <array>
#include <span>

#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Writes one frame into a surface. Blocks may come in any order, each once.
class SurfaceStore {
 public:
  static constexpr uint32_t kKeptBlocks = 32;

  /// Call it after encoder.begin_frame(). Re-uses the buffers of `out`, which it does not own.
  void begin_frame(const SchemeSpec& spec, const ModelOptions& options, const FrameContext& frame,
                   const BlockEncoder& encoder, CompressedSurface& out);
  /// Stores a block and returns its payload bits.
  uint32_t put(const BlockEncoder& encoder, const BlockContext& block);
  /// Keeps the block stored last at `place`, for put_again() in this frame.
  void keep(uint32_t place) { kept_[place] = last_; }
  /// Stores the block kept at `place` as blocks `bx` to `bx_end` of row `by`.
  void put_again(uint32_t place, uint32_t bx, uint32_t bx_end, uint32_t by);

 private:
  static constexpr uint32_t kMaxCsbBytes = 32;
  struct Put {
    uint64_t number = 0;                      ///< of the block
    std::array<uint8_t, kMaxCsbBytes> csb{};  ///< its bits
  };
  void put_csb(const Put& put, uint64_t first, uint32_t count);
  uint8_t* payload_ = nullptr;  ///< of the surface, like the members below
  uint16_t* block_bits_ = nullptr;
  std::span<uint8_t> csb_;
  uint32_t csb_bits_ = 0;               ///< of a block
  uint64_t blocks_ = 0, blocks_x_ = 0;  ///< kept, as slot_bytes_, to save divisions per block
  size_t slot_bytes_ = 0;
  Put last_;
  std::array<Put, kKeptBlocks> kept_;
};

}  // namespace tilepress
