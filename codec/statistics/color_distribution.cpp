// Color distribution: one pass finds the sizes of the groups, one fills them, one counts.
#include "statistics/color_distribution.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tilepress {
namespace {

constexpr uint32_t kValues = 65536;
constexpr uint32_t kExact = CountProfile::kSmall;

uint32_t group_of(uint32_t color) {
  return color >> 16;
}
uint16_t value_of(uint32_t color) {
  return static_cast<uint16_t>(color);
}

/// Visits every pixel, from four places of a row by turns: neighbours are often alike, and to count one thing
/// again and again is to wait for the store before.
template <typename Visit>
void for_each_pixel(const PixelPlane& frame, const Visit& visit) {
  const uint32_t quarter = frame.width() / 4;
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < quarter; ++x) {
      visit(row[x]);
      visit(row[x + quarter]);
      visit(row[x + 2 * quarter]);
      visit(row[x + 3 * quarter]);
    }
    for (uint32_t x = 4 * quarter; x < frame.width(); ++x) visit(row[x]);
  }
}

}  // namespace

struct ColorDistribution::Tables {
  struct Entry {
    int32_t lead;    ///< pixels of this colour the frame before has more of
    uint32_t count;  ///< pixels of this colour in the frame
  };
  /// Sizes of the groups, then where the next pixel of each goes.
  std::vector<uint32_t> next = std::vector<uint32_t>(kGroups);
  std::vector<Entry> entries = std::vector<Entry>(kValues);  ///< of one group; all zero between groups
  /// How often a count was raised from this one, in four copies: see for_each_pixel.
  std::array<std::array<uint32_t, kExact>, 4> raised;
  std::vector<uint16_t> large;  ///< values counted kExact times and more in one group

  uint64_t raised_from(uint32_t count) const {
    return uint64_t{raised[0][count]} + raised[1][count] + raised[2][count] + raised[3][count];
  }
  uint64_t count_group(std::span<const uint16_t> now, std::span<const uint16_t> before);
  void clear_group(std::span<const uint16_t> now, std::span<const uint16_t> before);
};

ColorDistribution::Tables& ColorDistribution::tables_of_thread() {
  thread_local Tables tables;
  return tables;
}

uint64_t ColorDistribution::Tables::count_group(std::span<const uint16_t> now,
                                                std::span<const uint16_t> before) {
  Entry* table = entries.data();
  for (const uint16_t value : before) ++table[value].lead;
  uint64_t gained = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    Entry& entry = table[now[i]];
    gained += entry.lead <= 0;  // the frame before has no pixel of this colour left to pair with
    --entry.lead;
    const uint32_t count = entry.count++;
    ++raised[i & 3][std::min(count, kExact - 1)];
    if (count == kExact - 1) large.push_back(now[i]);
  }
  return gained;
}

void ColorDistribution::Tables::clear_group(std::span<const uint16_t> now, std::span<const uint16_t> before) {
  if (now.size() + before.size() > kValues) {
    std::fill(entries.begin(), entries.end(), Entry{});
    return;
  }
  for (const uint16_t value : now) entries[value] = {};
  for (const uint16_t value : before) entries[value] = {};
}

void ColorDistribution::note_sizes(std::vector<uint32_t>& next, size_t pixels, Grouped& out) {
  out.values.resize(pixels);
  out.sizes.resize(kGroups);
  out.large_sizes.clear();
  uint32_t begin = 0;
  for (uint32_t group = 0; group < kGroups; ++group) {
    const uint32_t size = std::exchange(next[group], begin);
    begin += size;
    out.sizes[group] = static_cast<uint8_t>(std::min(size, kManyValues));
    if (size >= kManyValues) out.large_sizes.push_back(size);
  }
}

void ColorDistribution::distribute(const PixelPlane& frame, std::vector<uint32_t>& table, Grouped& out) {
  std::fill(table.begin(), table.end(), 0u);
  uint32_t* next = table.data();
  for_each_pixel(frame, [next](uint32_t color) { ++next[group_of(color)]; });
  note_sizes(table, size_t{frame.width()} * frame.height(), out);
  uint16_t* values = out.values.data();
  for_each_pixel(frame,
                 [next, values](uint32_t color) { values[next[group_of(color)]++] = value_of(color); });
}

void ColorDistribution::load(const ColorHistogram& colors) {
  std::vector<uint32_t>& next = tables_of_thread().next;
  std::fill(next.begin(), next.end(), 0u);
  size_t pixels = 0;
  for (const ColorHistogram::Entry& entry : colors.table()) {
    next[group_of(entry.color)] += entry.count;
    pixels += entry.count;
  }
  note_sizes(next, pixels, last_);
  for (const ColorHistogram::Entry& entry : colors.table()) {
    std::fill_n(last_.values.begin() + next[group_of(entry.color)], entry.count, value_of(entry.color));
    next[group_of(entry.color)] += entry.count;
  }
}

ColorDistribution::Change ColorDistribution::count_groups(Tables& tables, const Grouped& now,
                                                          const Grouped* before,
                                                          std::span<const uint32_t> held_colors,
                                                          CountProfile& profile) {
  /// Goes through the groups of a frame.
  struct Cursor {
    const Grouped& frame;
    size_t begin = 0, large = 0;
    std::span<const uint16_t> take(uint32_t group) {
      size_t size = frame.sizes[group];
      if (size == kManyValues) size = frame.large_sizes[large++];
      return {frame.values.data() + std::exchange(begin, begin + size), size};
    }
  };
  Cursor now_cursor{now}, before_cursor{before != nullptr ? *before : now};
  Change change;
  for (auto& copy : tables.raised) copy.fill(0);
  uint64_t large_colors = 0;
  auto held = held_colors.begin();
  for (uint32_t group = 0; group < kGroups; ++group) {
    const auto values_before = before != nullptr ? before_cursor.take(group) : std::span<const uint16_t>();
    const auto values = now_cursor.take(group);
    if (values.empty()) continue;  // what the frame before had here, no colour gains
    tables.large.clear();
    change.gained += tables.count_group(values, values_before);
    for (const uint16_t value : tables.large) profile.add(tables.entries[value].count);
    large_colors += tables.large.size();
    while (held != held_colors.end() && group_of(*held) < group) ++held;
    for (; held != held_colors.end() && group_of(*held) == group; ++held)
      change.held += tables.entries[value_of(*held)].count;
    tables.clear_group(values, values_before);
  }
  // As many colours were raised from n as have more than n pixels.
  for (uint32_t count = 1; count < kExact; ++count)
    profile.add_small(count, tables.raised_from(count - 1) -
                                 (count + 1 == kExact ? large_colors : tables.raised_from(count)));
  if (before == nullptr) change.gained = 0;
  return change;
}

ColorDistribution::Change ColorDistribution::count(const PixelPlane& frame, bool compare,
                                                   std::span<uint32_t> held_colors, CountProfile& profile) {
  Tables& tables = tables_of_thread();
  std::sort(held_colors.begin(), held_colors.end());
  distribute(frame, tables.next, spare_);
  const Change change = count_groups(tables, spare_, compare ? &last_ : nullptr, held_colors, profile);
  std::swap(last_, spare_);
  return change;
}

}  // namespace tilepress
