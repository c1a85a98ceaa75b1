// Changed units: memcmp per unit, and a bit map read a byte at a time where all its bits are equal.
#include "study/cache/changed_units.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tilepress {
namespace {

size_t unit_count(size_t frame_bytes) {
  return (frame_bytes + kUnitBytes - 1) / kUnitBytes;
}

}  // namespace

size_t mark_changed_units(std::span<const std::byte> frame, std::span<const std::byte> before,
                          std::string& map) {
  map.assign(unit_map_bytes(frame.size()), '\0');
  size_t changed = 0;
  for (size_t unit = 0, at = 0; at < frame.size(); ++unit, at += kUnitBytes) {
    const size_t bytes = std::min(kUnitBytes, frame.size() - at);
    const bool equal = bytes == kUnitBytes ? std::memcmp(&frame[at], &before[at], kUnitBytes) == 0
                                           : std::memcmp(&frame[at], &before[at], bytes) == 0;
    if (equal) continue;
    map[unit / 8] = static_cast<char>(map[unit / 8] | 1 << (unit % 8));
    changed += bytes;
  }
  return changed;
}

ChangedRuns::ChangedRuns(std::span<const std::byte> map, size_t frame_bytes)
    : map_(map), frame_bytes_(frame_bytes), units_(unit_count(frame_bytes)) {}

/// First unit from `unit` on whose bit is not `value`, or the number of units.
size_t ChangedRuns::skip(size_t unit, bool value) const {
  if (map_.empty()) return value ? units_ : unit;
  const auto whole = value ? std::byte{0xFF} : std::byte{0};
  while (unit < units_) {
    if (unit % 8 == 0 && map_[unit / 8] == whole)
      unit += 8;
    else if (changed(unit) == value)
      ++unit;
    else
      break;
  }
  return std::min(unit, units_);
}

bool ChangedRuns::next(ChangedRun& run) {
  const size_t first = skip(unit_, false);
  if (first >= units_) return false;
  unit_ = skip(first, true);
  run = {first * kUnitBytes, std::min(unit_ * kUnitBytes, frame_bytes_)};
  return true;
}

size_t changed_bytes(std::span<const std::byte> map, size_t frame_bytes) {
  if (map.empty()) return frame_bytes;
  size_t units = 0;
  for (const std::byte each : map) units += static_cast<size_t>(std::popcount(static_cast<uint8_t>(each)));
  const size_t last = unit_count(frame_bytes) - 1,
               short_by = unit_count(frame_bytes) * kUnitBytes - frame_bytes;
  const bool last_changed = (static_cast<unsigned>(map[last / 8]) >> (last % 8) & 1u) != 0;
  return units * kUnitBytes - (last_changed ? short_by : 0);
}

bool has_stray_bits(std::span<const std::byte> map, size_t frame_bytes) {
  const size_t used = unit_count(frame_bytes) % 8;
  return used != 0 && (static_cast<unsigned>(map.back()) >> used) != 0;
}

}  // namespace tilepress
