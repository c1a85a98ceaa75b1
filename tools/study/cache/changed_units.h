// Changed units: which 64-byte units of a frame differ from the frame before.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tilepress {

/// A frame is cut into units from its first byte on, whatever its rows are. The last unit may be shorter.
constexpr size_t kUnitBytes = 64;

/// Bytes of a map with one bit per unit, unit 0 in the lowest bit of byte 0. Bits past the last unit are 0.
constexpr size_t unit_map_bytes(size_t frame_bytes) {
  return (frame_bytes + kUnitBytes * 8 - 1) / (kUnitBytes * 8);
}

/// Fills `map` for a frame and the frame before, which have equal sizes. Returns the bytes of changed units.
size_t mark_changed_units(std::span<const std::byte> frame, std::span<const std::byte> before,
                          std::string& map);

/// A run of changed bytes.
struct ChangedRun {
  size_t begin = 0, end = 0;  ///< in the frame
  size_t bytes() const { return end - begin; }
};

/// Walks over the runs of changed units in rising order.
class ChangedRuns {
 public:
  /// An empty `map` stands for one run over the whole frame. `map` must outlive this.
  ChangedRuns(std::span<const std::byte> map, size_t frame_bytes);
  /// Returns false after the last run.
  bool next(ChangedRun& run);

 private:
  bool changed(size_t unit) const {
    return map_.empty() || (static_cast<unsigned>(map_[unit / 8]) >> (unit % 8) & 1u) != 0;
  }
  size_t skip(size_t unit, bool value) const;
  std::span<const std::byte> map_;
  size_t frame_bytes_, units_, unit_ = 0;
};

/// Bytes of all runs of a map. Returns nothing valid for bits past the last unit: has_stray_bits() checks
/// them.
size_t changed_bytes(std::span<const std::byte> map, size_t frame_bytes);
bool has_stray_bits(std::span<const std::byte> map, size_t frame_bytes);

}  // namespace tilepress
