// Colour distribution: a pass for the sizes of the groups, a pass that fills them, a pass that counts.
#include "statistics/color_distribution.h"

#include <algorithm>
#include <array>
#include <utility>

#include "cpu/mask_runs.h"
#include "pixels/pixel_kernels.h"

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

/// Visits every pixel, from four places of a row in turn. Neighbours are often alike, and a count that is
/// raised twice in a row waits for its own store.
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

/// Calls visit(colour, length) for each run of equal pixels. A run ends at the latest after 64 pixels.
template <typename Visit>
void for_each_run(const PixelPlane& frame, uint32_t y, const Visit& visit) {
  const PixelKernels& kernels = pixel_kernels();
  const uint32_t* row = frame.row(y);
  uint32_t last[kBlockPixels];
  for (uint32_t x = 0; x < frame.width(); x += kBlockPixels) {
    const uint32_t inside = std::min(kBlockPixels, frame.width() - x);
    const uint32_t* pixels = row + x;
    if (inside < kBlockPixels) {
      std::fill(std::copy_n(pixels, inside, last), last + kBlockPixels, pixels[inside - 1]);
      pixels = last;
    }
    for_each_mask_run(kernels.run_begins(pixels), inside,
                      [&](uint32_t first, uint32_t length) { visit(pixels[first], length); });
  }
}

/// Returns true if runs are common, judged by every 64th row.
bool has_runs(const PixelPlane& frame) {
  constexpr uint32_t kEvery = 64;
  size_t runs = 0, pixels = 0;
  for (uint32_t y = 0; y < frame.height(); y += kEvery, pixels += frame.width())
    for_each_run(frame, y, [&runs](uint32_t, uint32_t) { ++runs; });
  return runs * 4 < pixels * 3;
}

}  // namespace

struct ColorDistribution::Tables {
  struct Entry {
    int32_t lead;    ///< how many more pixels of this colour the frame before has
    uint32_t count;  ///< pixels of this colour in the frame
  };
  /// The sizes of the groups, later the position of the next pixel of each group.
  std::vector<uint32_t> next = std::vector<uint32_t>(kGroups);
  std::vector<Entry> entries = std::vector<Entry>(kValues);  ///< of one group; all zero between groups
  /// By count, in four copies (see for_each_pixel): how often a pixel raised a count from this one, and how
  /// many colours counted run by run have this count. Undefined for 0; kExact - 1 stands for all larger
  /// counts.
  std::array<std::array<uint32_t, kExact>, 4> raised{}, colors{};
  std::vector<uint16_t> large;  ///< values counted kExact - 1 times and more in one group of pixels

  /// The values of a group and the pixels of each.
  struct Span {
    const uint16_t* values;
    const uint8_t* weights;  ///< null: one pixel each
    size_t size;
  };
  template <typename Visit>
  static void for_each(const Span& span, const Visit& visit) {
    if (span.weights == nullptr)
      for (size_t i = 0; i < span.size; ++i) visit(span.values[i], 1);
    else
      for (size_t i = 0; i < span.size; ++i) visit(span.values[i], span.weights[i]);
  }
  static uint64_t sum(const std::array<std::array<uint32_t, kExact>, 4>& copies, uint32_t count) {
    return uint64_t{copies[0][count]} + copies[1][count] + copies[2][count] + copies[3][count];
  }
  uint64_t count_group(const Span& now, const Span& before);
  uint64_t count_pixels(const Span& now);
  uint64_t count_runs(const Span& now);
  /// Adds the larger counts to `profile`.
  void clear_group(const Span& now, const Span& before, CountProfile& profile);
  void take_profile(CountProfile& profile);
};

// Not inline: else every use would compute the thread's address again.
[[gnu::noinline]] ColorDistribution::Tables& ColorDistribution::tables_of_thread() {
  thread_local Tables tables;
  return tables;
}

/// Returns how many of the group's pixels have no pixel of their colour left in the frame before.
uint64_t ColorDistribution::Tables::count_group(const Span& now, const Span& before) {
  Entry* table = entries.data();
  for_each(before, [table](uint16_t value, int32_t weight) { table[value].lead += weight; });
  return now.weights == nullptr ? count_pixels(now) : count_runs(now);
}

uint64_t ColorDistribution::Tables::count_pixels(const Span& now) {
  Entry* table = entries.data();
  uint64_t gained = 0;
  for (size_t i = 0; i < now.size; ++i) {
    Entry& entry = table[now.values[i]];
    gained += entry.lead <= 0;
    --entry.lead;
    const uint32_t count = entry.count++;
    ++raised[i & 3][std::min(count, kExact - 1)];
    if (count == kExact - 2) large.push_back(now.values[i]);
  }
  return gained;
}

uint64_t ColorDistribution::Tables::count_runs(const Span& now) {
  Entry* table = entries.data();
  uint64_t gained = 0;
  for_each(now, [table, &gained](uint16_t value, int32_t weight) {
    Entry& entry = table[value];
    gained += static_cast<uint32_t>(weight - std::clamp(entry.lead, 0, weight));
    entry.lead -= weight;
    entry.count += static_cast<uint32_t>(weight);
  });
  return gained;
}

void ColorDistribution::Tables::clear_group(const Span& now, const Span& before, CountProfile& profile) {
  Entry* table = entries.data();
  for (const uint16_t value : large) profile.add(table[value].count);
  large.clear();
  uint32_t visited = 0;
  const auto take = [&](Entry& entry) {
    const uint32_t count = std::exchange(entry, Entry{}).count;
    ++colors[visited++ & 3][std::min(count, kExact - 1)];
    if (count >= kExact - 1) profile.add(count);
  };
  const bool few = now.size + before.size <= kValues;
  if (now.weights != nullptr && few)
    for (size_t i = 0; i < now.size; ++i) take(table[now.values[i]]);
  else if (now.weights != nullptr)
    for (Entry& entry : entries) take(entry);
  else if (few)
    for (size_t i = 0; i < now.size; ++i) table[now.values[i]] = {};
  else
    std::fill(entries.begin(), entries.end(), Entry{});
  for (size_t i = 0; few && i < before.size; ++i) table[before.values[i]] = {};
}

void ColorDistribution::Tables::take_profile(CountProfile& profile) {
  // The colours raised from n are the colours of more than n pixels.
  for (uint32_t count = 1; count + 1 < kExact; ++count)
    profile.add_small(count, sum(colors, count) + sum(raised, count - 1) - sum(raised, count));
  for (auto& copy : raised) copy.fill(0);
  for (auto& copy : colors) copy.fill(0);
}

void ColorDistribution::note_sizes(std::vector<uint32_t>& next, Grouped& out) {
  out.sizes.resize(kGroups);
  out.large_sizes.clear();
  uint32_t begin = 0;
  for (uint32_t group = 0; group < kGroups; ++group) {
    const uint32_t size = std::exchange(next[group], begin);
    begin += size;
    out.sizes[group] = static_cast<uint8_t>(std::min(size, kManyValues));
    if (size >= kManyValues) out.large_sizes.push_back(size);
  }
  out.values.resize(begin);
}

void ColorDistribution::distribute(const PixelPlane& frame, std::vector<uint32_t>& table, Grouped& out) {
  const size_t pixels = size_t{frame.width()} * frame.height();
  out.values.reserve(pixels);  // the most that any frame needs
  std::fill(table.begin(), table.end(), 0u);
  uint32_t* __restrict next = table.data();
  if (!has_runs(frame)) {
    for_each_pixel(frame, [next](uint32_t color) { ++next[group_of(color)]; });
    note_sizes(table, out);
    out.weights.clear();
    uint16_t* __restrict values = out.values.data();
    for_each_pixel(frame,
                   [next, values](uint32_t color) { values[next[group_of(color)]++] = value_of(color); });
    return;
  }
  for (uint32_t y = 0; y < frame.height(); ++y)
    for_each_run(frame, y, [next](uint32_t color, uint32_t) { ++next[group_of(color)]; });
  note_sizes(table, out);
  out.weights.reserve(std::max(out.values.size(), pixels / 4 * 3));
  out.weights.resize(out.values.size());
  uint16_t* __restrict values = out.values.data();
  uint8_t* __restrict weights = out.weights.data();
  for (uint32_t y = 0; y < frame.height(); ++y)
    for_each_run(frame, y, [next, values, weights](uint32_t color, uint32_t length) {
      const uint32_t at = next[group_of(color)]++;
      values[at] = value_of(color);
      weights[at] = static_cast<uint8_t>(length);
    });
}

void ColorDistribution::load_before(const ColorHistogram& colors) {
  std::vector<uint32_t>& next = tables_of_thread().next;
  std::fill(next.begin(), next.end(), 0u);
  colors.for_each_before([&](uint32_t color, uint32_t count) { next[group_of(color)] += count; });
  note_sizes(next, last_);
  last_.weights.clear();
  colors.for_each_before([&](uint32_t color, uint32_t count) {
    std::fill_n(last_.values.begin() + next[group_of(color)], count, value_of(color));
    next[group_of(color)] += count;
  });
}

uint64_t ColorDistribution::count_groups(Tables& tables, const Grouped& now, const Grouped* before,
                                         std::span<WantedColor> wanted, CountProfile& profile) {
  /// Walks the groups of a frame.
  struct Cursor {
    const Grouped& frame;
    size_t begin = 0, large = 0;
    Tables::Span take(uint32_t group) {
      size_t size = frame.sizes[group];
      if (size == kManyValues) size = frame.large_sizes[large++];
      const size_t at = std::exchange(begin, begin + size);
      return {frame.values.data() + at, frame.weights.empty() ? nullptr : frame.weights.data() + at, size};
    }
  };
  Cursor now_cursor{now}, before_cursor{before != nullptr ? *before : now};
  uint64_t gained = 0;
  auto want = wanted.begin();
  for (uint32_t group = 0; group < kGroups; ++group) {
    const auto values_before = before != nullptr ? before_cursor.take(group) : Tables::Span{};
    const auto values = now_cursor.take(group);
    if (values.size == 0) continue;  // no colour gains here
    gained += tables.count_group(values, values_before);
    while (want != wanted.end() && group_of(want->color) < group) ++want;
    for (; want != wanted.end() && group_of(want->color) == group; ++want)
      want->count = tables.entries[value_of(want->color)].count;
    tables.clear_group(values, values_before, profile);
  }
  tables.take_profile(profile);
  return before != nullptr ? gained : 0;
}

uint64_t ColorDistribution::count(const PixelPlane& frame, bool compare, std::span<WantedColor> wanted,
                                  CountProfile& profile) {
  Tables& tables = tables_of_thread();
  distribute(frame, tables.next, spare_);
  const uint64_t gained = count_groups(tables, spare_, compare ? &last_ : nullptr, wanted, profile);
  std::swap(last_, spare_);
  return gained;
}

}  // namespace tilepress
