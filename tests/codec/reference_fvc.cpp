// Reference model: traversal order, FVC and frame metrics.
#include <algorithm>
#include <cmath>
#include <map>

#include "reference_model.h"

namespace reference {

std::vector<Place> traversal(uint32_t width, uint32_t height, uint32_t tile_side) {
  std::vector<Place> places;
  const uint32_t padded_width = (width + 7) / 8 * 8, padded_height = (height + 7) / 8 * 8;
  for (uint32_t tile_y = 0; tile_y < padded_height; tile_y += tile_side)
    for (uint32_t tile_x = 0; tile_x < padded_width; tile_x += tile_side)
      for (uint32_t block_y = tile_y; block_y < tile_y + tile_side; block_y += 8)
        for (uint32_t block_x = tile_x; block_x < tile_x + tile_side; block_x += 8) {
          if (block_x >= padded_width || block_y >= padded_height) continue;
          for (uint32_t sub_y = block_y; sub_y < block_y + 8; sub_y += 2)
            for (uint32_t sub_x = block_x; sub_x < block_x + 8; sub_x += 2)
              for (uint32_t y = sub_y; y < sub_y + 2; ++y)
                for (uint32_t x = sub_x; x < sub_x + 2; ++x)
                  places.push_back({x, y, x < width && y < height});
        }
  return places;
}

namespace {

uint32_t xor_of_channels(uint32_t word, PixelFormat format) {
  if (format == PixelFormat::kRgb565) return (word >> 11 & 31) ^ (word >> 5 & 63) ^ (word & 31);
  if (format == PixelFormat::kRgb10a2)
    return (word & 1023) ^ (word >> 10 & 1023) ^ (word >> 20 & 1023) ^ (word >> 30);
  return (word & 255) ^ (word >> 8 & 255) ^ (word >> 16 & 255) ^ (word >> 24);
}

/// The ways of one set with the least `key`, lowest slot first among equals, leaving out slot `except`.
template <typename Key>
uint32_t least(const std::vector<Slot>& slots, uint32_t low, uint32_t ways, int64_t except, Key key) {
  int64_t best = -1;
  for (uint32_t slot = low; slot < low + ways; ++slot) {
    if (slot == except) continue;
    if (best < 0 || key(slots[slot]) < key(slots[static_cast<size_t>(best)])) best = slot;
  }
  return static_cast<uint32_t>(best);
}

}  // namespace

Collection collect(const SchemeSpec& spec, PixelFormat format, const Picture& picture, uint32_t tile_side) {
  const uint32_t entries = number_of(spec, "fvc", 64), sample = number_of(spec, "sample", 1);
  const uint32_t policy = number_of(spec, "policy", 0);  // as the key lists them: lfc, 2lfc, lru, random
  const uint32_t ways = number_of(spec, "ways", 0) == 0 ? entries : number_of(spec, "ways", 0);
  const uint32_t sets = entries / ways;
  Collection result;
  result.slots.resize(entries);
  uint32_t random = 0x9E3779B9;
  uint64_t pixel_number = 0;
  for (const Place& place : traversal(picture.width, picture.height, tile_side)) {
    if (!place.inside) continue;
    if (pixel_number++ % sample != 0) continue;
    const uint64_t now = ++result.samples;
    const uint32_t color = picture.at(place.x, place.y);
    const uint32_t low = xor_of_channels(color, format) % sets * ways;
    int64_t hit = -1, empty = -1;
    for (uint32_t slot = low; slot < low + ways; ++slot) {
      if (result.slots[slot].valid && result.slots[slot].color == color) hit = slot;
      if (!result.slots[slot].valid && empty < 0) empty = slot;
    }
    if (hit >= 0) {
      Slot& slot = result.slots[static_cast<size_t>(hit)];
      slot.count += 1;
      slot.used = now;
      continue;
    }
    uint32_t target = 0;
    const auto count = [](const Slot& slot) { return slot.count; };
    const auto used = [](const Slot& slot) { return slot.used; };
    if (empty >= 0) {
      target = static_cast<uint32_t>(empty);
    } else if (policy == 0) {
      target = least(result.slots, low, ways, -1, count);
    } else if (policy == 1) {
      target = least(result.slots, low, ways, -1, count);
      if (ways > 1) target = least(result.slots, low, ways, target, count);
    } else if (policy == 2) {
      target = least(result.slots, low, ways, -1, used);
    } else {
      random ^= random << 13;
      random ^= random >> 17;
      random ^= random << 5;
      target = low + random % ways;
    }
    result.slots[target] = {true, color, 1, now};
  }
  return result;
}

Metrics Meter::frame(const Picture& picture) {
  Metrics metrics;
  const double pixels = double(picture.width) * picture.height;
  std::map<uint32_t, uint64_t> now, before;
  for (const uint32_t color : picture.words) ++now[color];
  metrics.unique_colors = now.size();
  std::vector<uint64_t> counts;
  for (const auto& [color, count] : now) {
    metrics.entropy -= count / pixels * std::log2(count / pixels);
    counts.push_back(count);
  }
  std::sort(counts.rbegin(), counts.rend());
  const auto most_frequent = [&](size_t colors) {
    uint64_t sum = 0;
    for (size_t i = 0; i < colors && i < counts.size(); ++i) sum += counts[i];
    return sum;
  };
  if (!first_) {
    uint64_t changed = 0, differences = 0;
    for (size_t i = 0; i < picture.words.size(); ++i) changed += picture.words[i] != before_.words[i];
    for (const uint32_t color : before_.words) ++before[color];
    for (const auto& [color, count] : now)
      differences += count > before[color] ? count - before[color] : before[color] - count;
    for (const auto& [color, count] : before)
      if (now.count(color) == 0) differences += count;
    metrics.pixel_change = changed / pixels;
    metrics.color_change = differences / 2.0 / pixels;
  }
  const Collection collection = collect(SchemeSpec{}, format_, picture, tile_side_);
  uint64_t counted = 0, held = 0, colors = 0;
  for (const Slot& slot : collection.slots) {
    if (!slot.valid) continue;
    counted += slot.count;
    held += now[slot.color];
    ++colors;
  }
  metrics.fvc_coverage = double(counted) / collection.samples;
  metrics.fvc_relative_coverage = double(held) / most_frequent(colors);
  metrics.top100_coverage = most_frequent(100) / pixels;
  before_ = picture;
  first_ = false;
  return metrics;
}

}  // namespace reference
