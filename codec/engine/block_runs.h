// Block runs: which blocks repeat a block of one colour, and how often.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "memory/surface_store.h"
#include "pixels/pixel_kernels.h"
#include "tilepress/plane.h"

namespace tilepress {

/// A few colours fill most of a screen, and the bits of a block of one colour depend on that colour alone. So
/// the engine measures the first block of a colour and counts the others. Each colour has one place; a new
/// colour replaces the colour held there.
class BlockRuns {
 public:
  static constexpr uint32_t kPlaces = SurfaceStore::kKeptBlocks;  ///< a power of two

  /// `counts` false: each block is measured.
  void open(bool counts) { counts_ = counts; }
  /// Precondition: all repeats are taken.
  void begin_frame() {
    places_ = {};
    in_run_ = false;
  }

  /// The block visited last was of one colour. Returns how many of blocks `bx` to `bx_end` of row `by`, from
  /// `bx` on, have the same colour.
  uint32_t count_on(const PixelPlane& plane, uint32_t bx, uint32_t bx_end, uint32_t by) const {
    if (!in_run_ || !counts_) return 0;
    const uint32_t* top_left = plane.row(by * kBlockSide) + bx * kBlockSide;
    return pixel_kernels().solid_blocks(top_left, plane.stride(), color(), bx_end - bx);
  }
  /// The block at hand has more than one colour.
  void leave() { in_run_ = false; }
  /// The block at hand is of one colour; place() is the place of that colour from now on. Returns true if the
  /// place holds the colour, so that the block repeats one measured before.
  bool enter(uint32_t color) {
    in_run_ = true;
    place_ = color * 0x9E3779B1u >> (32 - std::countr_zero(kPlaces));
    return counts_ && places_[place_].held && places_[place_].color == color;
  }
  uint32_t place() const { return place_; }
  uint32_t color() const { return places_[place_].color; }
  /// Holds a colour at place(). Precondition: the repeats of the place are taken.
  void hold(uint32_t color) { places_[place_] = {.color = color, .held = true, .repeats = 0}; }
  void repeat(uint32_t blocks) { places_[place_].repeats += blocks; }
  uint64_t take_repeats(uint32_t place) { return std::exchange(places_[place].repeats, 0); }

 private:
  struct Place {
    uint32_t color = 0;
    bool held = false;
    uint64_t repeats = 0;
  };
  std::array<Place, kPlaces> places_;
  bool counts_ = true;
  bool in_run_ = false;  ///< the block visited last was of one colour, which place_ holds
  uint32_t place_ = 0;
};

}  // namespace tilepress
