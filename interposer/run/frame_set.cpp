// Frame set: ranges that are sorted and do not touch.
#include "tilepress/frame_set.h"

#include <algorithm>
#include <ranges>

#include "tilepress/csv_table.h"

namespace tilepress {

Result<FrameSet> FrameSet::parse(std::string_view text) {
  FrameSet set;
  const Error no_range{ErrorKind::kBadValue, "empty range"};
  if (text.empty()) return no_range;
  for (const auto& word : std::views::split(text, ',')) {
    const std::string_view part(word.begin(), word.end());
    if (part.empty()) return no_range;
    const size_t dash = part.find('-');
    const std::string_view first_text = part.substr(0, dash);
    const std::string_view last_text = dash == std::string_view::npos ? first_text : part.substr(dash + 1);
    Range range{};
    if (!read_csv(first_text, range.first) || !read_csv(last_text, range.last))
      return Error{ErrorKind::kBadValue,
                   std::string("'").append(part).append("' is not a frame or a range of frames")};
    if (range.first > range.last) return Error{ErrorKind::kBadValue, "reversed range " + std::string(part)};
    set.ranges_.push_back(range);
  }
  // Sorted and merged, so that contains() can search and text() is the shortest.
  std::sort(set.ranges_.begin(), set.ranges_.end(),
            [](const Range& a, const Range& b) { return a.first < b.first; });
  std::vector<Range> merged;
  for (const Range& range : set.ranges_) {
    if (!merged.empty() && (range.first <= merged.back().last || range.first - merged.back().last == 1))
      merged.back().last = std::max(merged.back().last, range.last);
    else
      merged.push_back(range);
  }
  set.ranges_ = std::move(merged);
  return set;
}

bool FrameSet::contains(uint64_t frame) const {
  if (ranges_.empty()) return true;
  const auto after = std::upper_bound(ranges_.begin(), ranges_.end(), frame,
                                      [](uint64_t value, const Range& range) { return value < range.first; });
  return after != ranges_.begin() && frame <= std::prev(after)->last;
}

std::optional<uint64_t> FrameSet::last() const {
  if (ranges_.empty()) return std::nullopt;
  return ranges_.back().last;
}

std::string FrameSet::text() const {
  std::string out;
  for (const Range& range : ranges_) {
    if (!out.empty()) out += ',';
    out += std::to_string(range.first);
    if (range.last != range.first) out += '-' + std::to_string(range.last);
  }
  return out;
}

}  // namespace tilepress
