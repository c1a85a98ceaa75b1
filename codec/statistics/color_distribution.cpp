// Color distribution: one pass finds the sizes of the groups, one fills them, one counts.
#include "statistics/color_distribution.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tilepress {
namespace {

constexpr uint32_t kGroups = 65536, kValues = 65536;
constexpr uint32_t kExact = CountProfile::kSmall;

uint32_t group_of(uint32_t color) {
  return color >> 16;
}

struct Tables {
  struct Entry {
    int32_t lead;    ///< pixels of this colour the frame before has more of
    uint32_t count;  ///< pixels of this colour in the frame
  };
  /// Where the next pixel of a group goes; once all are there, the end of the group.
  std::vector<uint32_t> now = std::vector<uint32_t>(kGroups), before = std::vector<uint32_t>(kGroups);
  std::vector<Entry> entries = std::vector<Entry>(kValues);  ///< of one group; all zero between groups
  /// How often a count was raised from this one, in four copies: raising one number again and again would
  /// wait for the store before.
  std::array<std::array<uint32_t, kExact>, 4> raised;
  std::vector<uint32_t> large;  ///< values counted kExact times and more in one group

  uint64_t raised_from(uint32_t count) const {
    return uint64_t{raised[0][count]} + raised[1][count] + raised[2][count] + raised[3][count];
  }
};

Tables& tables_of_thread() {
  thread_local Tables tables;
  return tables;
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

/// Values of `frame` by group into `out`; `ends` will hold the end of each group.
template <typename Word>
void distribute(const PixelPlane& frame, std::vector<uint32_t>& ends, Word* out) {
  std::fill(ends.begin(), ends.end(), 0u);
  uint32_t* next = ends.data();
  for_each_pixel(frame, [next](uint32_t color) { ++next[group_of(color)]; });
  uint32_t begin = 0;
  for (uint32_t& end : ends) begin += std::exchange(end, begin);
  for_each_pixel(frame, [next, out](uint32_t color) {
    out[next[group_of(color)]++] = static_cast<Word>(color & 0xFFFF);
  });
}

template <typename Word>
uint64_t count_group(Tables& tables, std::span<const Word> now, std::span<const uint16_t> before) {
  Tables::Entry* entries = tables.entries.data();
  for (const uint16_t value : before) ++entries[value].lead;
  uint64_t gained = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    Tables::Entry& entry = entries[now[i]];
    gained += entry.lead <= 0;  // the frame before has no pixel of this colour left to pair with
    --entry.lead;
    const uint32_t count = entry.count++;
    ++tables.raised[i & 3][std::min(count, kExact - 1)];
    if (count == kExact - 1) tables.large.push_back(now[i]);
  }
  return gained;
}

template <typename Word>
void clear_group(Tables& tables, std::span<const Word> now, std::span<const uint16_t> before) {
  Tables::Entry* entries = tables.entries.data();
  if (now.size() + before.size() > kValues) {
    std::fill_n(entries, kValues, Tables::Entry{});
    return;
  }
  for (const Word value : now) entries[value] = {};
  for (const uint16_t value : before) entries[value] = {};
}

template <typename Word>
ColorDistribution::Change count_groups(Tables& tables, const Word* now, const uint16_t* before,
                                       std::span<const uint32_t> held_colors, CountProfile& profile) {
  ColorDistribution::Change change;
  for (auto& copy : tables.raised) copy.fill(0);
  uint64_t large_colors = 0;
  uint32_t now_begin = 0, before_begin = 0;
  auto held = held_colors.begin();
  for (uint32_t group = 0; group < kGroups; ++group) {
    const std::span<const Word> values(now + now_begin, now + tables.now[group]);
    const std::span<const uint16_t> values_before(before + before_begin, before + tables.before[group]);
    now_begin = tables.now[group];
    before_begin = tables.before[group];
    if (values.empty()) continue;  // what the frame before had here, no colour gains
    tables.large.clear();
    change.gained += count_group(tables, values, values_before);
    for (const uint32_t value : tables.large) profile.add(tables.entries[value].count);
    large_colors += tables.large.size();
    while (held != held_colors.end() && group_of(*held) < group) ++held;
    for (; held != held_colors.end() && group_of(*held) == group; ++held)
      change.held += tables.entries[*held & 0xFFFF].count;
    clear_group(tables, values, values_before);
  }
  // As many colours were raised from n as have more than n pixels.
  for (uint32_t count = 1; count < kExact; ++count)
    profile.add_small(count, tables.raised_from(count - 1) -
                                 (count + 1 == kExact ? large_colors : tables.raised_from(count)));
  return change;
}

}  // namespace

ColorDistribution::Change ColorDistribution::count(const PixelPlane& frame, PixelPlane* before,
                                                   std::span<uint32_t> held_colors, CountProfile& profile) {
  Tables& tables = tables_of_thread();
  values_.resize(size_t{frame.width()} * frame.height());
  std::sort(held_colors.begin(), held_colors.end());
  if (before == nullptr) {
    distribute(frame, tables.now, values_.data());
    std::fill(tables.before.begin(), tables.before.end(), 0u);
    Change change = count_groups(tables, values_.data(), values_.data(), held_colors, profile);
    change.gained = 0;
    return change;
  }
  distribute(*before, tables.before, values_.data());
  uint32_t* now = before->scratch();  // values_ has the frame before now, its plane is free
  distribute(frame, tables.now, now);
  return count_groups(tables, now, values_.data(), held_colors, profile);
}

}  // namespace tilepress
