// Solid blocks: the colours of the blocks of one colour that came in a frame, and how often each came again.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace tilepress {

/// Screens are filled with few colours, and what a block of one colour takes depends on that colour alone.
/// So the first block of a colour is measured, and others of it are counted. A colour has one place only,
/// and drives out the one that was there.
class SolidBlocks {
 public:
  static constexpr uint32_t kPlaces = 32;  ///< a power of two

  static uint32_t place_of(uint32_t color) { return color * 0x9E3779B1u >> (32 - std::countr_zero(kPlaces)); }
  /// Forgets all colours. Precondition: all repeats are taken.
  void clear() { places_ = {}; }
  bool holds(uint32_t place, uint32_t color) const {
    return places_[place].held && places_[place].color == color;
  }
  /// Precondition: the repeats of the place are taken.
  void keep(uint32_t place, uint32_t color) { places_[place] = {.color = color, .held = true, .repeats = 0}; }
  uint32_t color(uint32_t place) const { return places_[place].color; }
  void repeat(uint32_t place, uint32_t blocks) { places_[place].repeats += blocks; }
  uint64_t take_repeats(uint32_t place) {
    const uint64_t repeats = places_[place].repeats;
    places_[place].repeats = 0;
    return repeats;
  }

 private:
  struct Place {
    uint32_t color = 0;
    bool held = false;
    uint64_t repeats = 0;
  };
  std::array<Place, kPlaces> places_;
};

}  // namespace tilepress
