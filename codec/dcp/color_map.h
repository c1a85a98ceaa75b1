// Colour map: finds the slot of a colour among up to 1024, without a branch.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "dcp/probe_table.h"

namespace tilepress {

/// A cuckoo hash table of two halves, at most a quarter full, and less if it is small: a colour is at its
/// place in either half.
class ColorMap {
 public:
  static constexpr uint32_t kAbsent = 0xFFFFFFFF;

  explicit ColorMap(uint32_t most_colors)
      : places_(size_t{most_colors} * (most_colors <= 256 ? 16 : 4)),
        shift_(34 - static_cast<uint32_t>(std::bit_width(places_.size()))) {
    clear();
  }
  void clear() { std::fill(places_.begin(), places_.end(), Place{0, kAbsent}); }
  /// Returns the slot of the colour, or kAbsent.
  uint32_t find(uint32_t color) const {
    const Place &a = places_[place_of(color, 0)], &b = places_[place_of(color, 1)];
    return (a.slot | -uint32_t{a.color != color}) &
           (b.slot | -uint32_t{b.color != color});  // kAbsent: all ones
  }
  /// Precondition: the map lacks the colour.
  void insert(uint32_t color, uint32_t slot) {
    if (Place moving{color, slot}; !place(moving)) rehash(moving);
  }
  /// Precondition: the map has the colour.
  void remove(uint32_t color) {
    Place& a = places_[place_of(color, 0)];
    (a.color == color && a.slot != kAbsent ? a : places_[place_of(color, 1)]).slot = kAbsent;
  }

 private:
  struct Place {
    uint32_t color, slot;
  };
  uint32_t place_of(uint32_t color, uint32_t half) const {
    return (color * multipliers_[half] >> shift_) + half * static_cast<uint32_t>(places_.size() / 2);
  }
  /// A colour that finds its place taken moves the other colour to its other place, and so on. Returns false
  /// if the chain does not end; `moving` is the colour left then.
  bool place(Place& moving) {
    constexpr uint32_t kMoves = 64;
    Place &first = places_[place_of(moving.color, 0)], &second = places_[place_of(moving.color, 1)];
    if (Place& either = second.slot == kAbsent ? second : first; either.slot == kAbsent) {
      either = moving;
      return true;
    }
    for (uint32_t move = 0; move < kMoves && moving.slot != kAbsent; ++move)
      std::swap(moving, places_[place_of(moving.color, move % 2)]);
    return moving.slot == kAbsent;
  }
  /// Takes other multipliers until every colour has a place.
  void rehash(Place left) {
    std::vector<Place> held(1, left);
    for (const Place& each : places_)
      if (each.slot != kAbsent) held.push_back(each);
    const auto place_all = [&] {
      return std::all_of(held.begin(), held.end(), [&](Place each) { return place(each); });
    };
    do {
      for (uint32_t& multiplier : multipliers_) multiplier = ProbeTable::multiplier_of(next_multiplier_++);
      clear();
    } while (!place_all());
  }
  std::vector<Place> places_;
  uint32_t shift_;
  uint32_t multipliers_[2] = {ProbeTable::multiplier_of(0), ProbeTable::multiplier_of(1)};
  uint32_t next_multiplier_ = 2;
};

}  // namespace tilepress
