// Comparison text: the columns once, the three formats after.
#include "report/compare/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

using TextRow = std::vector<std::string>;

/// A table for a terminal or as Markdown.
struct TextGrid {
  std::string heading;  ///< empty: no heading
  TextRow header;
  std::vector<TextRow> rows;
  size_t text_columns = 1;  ///< leading columns that are aligned left
};

size_t shown_width(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, size_t width, bool right) {
  const std::string space(width - std::min(width, shown_width(text)), ' ');
  return right ? space + text : text + space;
}

/// Columns as wide as their longest cell. UTF-8 counts by character.
std::string grid_text(const TextGrid& grid, bool markdown) {
  std::vector<size_t> widths;
  for (size_t i = 0; i < grid.header.size(); ++i) {
    size_t width = std::max<size_t>(3, shown_width(grid.header[i]));
    for (const TextRow& row : grid.rows) width = std::max(width, shown_width(row[i]));
    widths.push_back(width);
  }
  const auto line = [&](const TextRow& row) {
    std::string out = markdown ? "|" : "";
    for (size_t i = 0; i < row.size(); ++i) {
      out += markdown ? " " : (i > 0 ? "  " : "");
      out += padded(row[i], widths[i], i >= grid.text_columns);
      if (markdown) out += " |";
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out + "\n";
  };
  std::string out;
  if (!grid.heading.empty())
    out = fmt::format("\n{}{}\n{}", markdown ? "### " : "", grid.heading, markdown ? "\n" : "");
  out += line(grid.header);
  if (markdown) {
    out += "|";
    for (size_t i = 0; i < widths.size(); ++i)
      out += i < grid.text_columns ? fmt::format(" {:-<{}} |", "", widths[i])
                                   : fmt::format(" {:->{}} |", ":", widths[i]);
    out += "\n";
  }
  for (const TextRow& row : grid.rows) out += line(row);
  return out;
}

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:+.2f} %", share * 100);
}
std::string rate_text(double rate) {
  return std::isnan(rate) ? "-" : fmt::format("{:.4f}", rate);
}
std::string exact(double value) {
  return std::isnan(value) ? "" : csv_number(value);
}

/// NaN for a scheme without rows: it does not support the surfaces' format.
double rate_of(const SchemeStatistics& sums) {
  return sums.raw_bits > 0 ? sums.rate() : NAN;
}

TextGrid scheme_grid(const std::vector<RunComparison>& runs) {
  TextGrid grid{"", {"workload", "scheme", "frames", "rate A", "rate B", "change", "better", "worse"}, {}, 2};
  for (const RunComparison& run : runs)
    for (const SchemeComparison& scheme : run.schemes) {
      const double a = rate_of(scheme.a), b = rate_of(scheme.b);
      grid.rows.push_back({run.name, scheme.scheme, std::to_string(scheme.frames.size()), rate_text(a),
                           rate_text(b), percent(relative_change(a, b)), std::to_string(scheme.better),
                           std::to_string(scheme.worse)});
    }
  return grid;
}

/// The frames to show of one scheme: all, or those whose rates differ most.
std::vector<FramePair> chosen_frames(const SchemeComparison& scheme, bool all) {
  std::vector<FramePair> frames = scheme.frames;
  if (all) return frames;
  std::erase_if(frames, [](const FramePair& pair) { return pair.a.rate() == pair.b.rate(); });
  const auto size = [](const FramePair& pair) {
    return std::abs(relative_change(pair.a.rate(), pair.b.rate()));
  };
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const FramePair& x, const FramePair& y) { return size(x) > size(y); });
  if (frames.size() > kWorstFrames) frames.resize(kWorstFrames);
  return frames;
}

TextGrid frame_grid(const std::vector<RunComparison>& runs, bool all) {
  TextGrid grid{all ? "Frame by frame" : "Frames that differ most",
                {"workload", "scheme", "surface", "frame", "rate A", "rate B", "change"},
                {},
                2};
  for (const RunComparison& run : runs)
    for (const SchemeComparison& scheme : run.schemes)
      for (const FramePair& pair : chosen_frames(scheme, all))
        grid.rows.push_back({run.name, scheme.scheme, std::to_string(pair.surface),
                             std::to_string(pair.frame), rate_text(pair.a.rate()), rate_text(pair.b.rate()),
                             percent(relative_change(pair.a.rate(), pair.b.rate()))});
  return grid;
}

std::string sizes_text(const SchemeStatistics& a, const SchemeStatistics& b) {
  return fmt::format(",{},{},{},{},{},{},{}\n", a.raw_bits, b.raw_bits, a.moved_bits(), b.moved_bits(),
                     exact(rate_of(a)), exact(rate_of(b)), exact(relative_change(rate_of(a), rate_of(b))));
}

std::string csv_text(const std::vector<RunComparison>& runs, bool per_frame) {
  TextRow header = {"workload", "scheme"};
  for (const char* name : {"surface", "frame"})
    if (per_frame) header.push_back(name);
  for (const char* name : {"frames", "better", "worse"})
    if (!per_frame) header.push_back(name);
  for (const char* name :
       {"raw_bits_a", "raw_bits_b", "moved_bits_a", "moved_bits_b", "rate_a", "rate_b", "change"})
    header.push_back(name);
  std::string out = fmt::format("{}\n", fmt::join(header, ","));
  for (const RunComparison& run : runs)
    for (const SchemeComparison& scheme : run.schemes) {
      const std::string names = csv_field(run.name) + "," + csv_field(scheme.scheme);
      if (!per_frame)
        out += fmt::format("{},{},{},{}", names, scheme.frames.size(), scheme.better, scheme.worse) +
               sizes_text(scheme.a, scheme.b);
      else
        for (const FramePair& pair : scheme.frames)
          out += fmt::format("{},{},{}", names, pair.surface, pair.frame) + sizes_text(pair.a, pair.b);
    }
  return out;
}

/// One line for each difference of the frames and schemes.
std::vector<std::string> picture_remarks(const RunComparison& run) {
  std::vector<std::string> out;
  if (run.only_a + run.only_b > 0)
    out.push_back(fmt::format("not the same frames: {} compared, {} only in A, {} only in B", run.common,
                              run.only_a, run.only_b));
  if (run.different_pictures > 0)
    out.push_back(fmt::format("not the same pictures: colours differ in {} of {} frames",
                              run.different_pictures, run.common));
  if (!run.schemes_only_a.empty())
    out.push_back(fmt::format("schemes only in A: {}", fmt::join(run.schemes_only_a, " ")));
  if (!run.schemes_only_b.empty())
    out.push_back(fmt::format("schemes only in B: {}", fmt::join(run.schemes_only_b, " ")));
  return out;
}

}  // namespace

std::string comparison_text(const std::vector<RunComparison>& runs, ComparisonFormat format, bool per_frame) {
  if (format == ComparisonFormat::kCsv) return csv_text(runs, per_frame);
  const bool markdown = format == ComparisonFormat::kMarkdown;
  std::string out;
  for (const RunComparison& run : runs)
    for (const std::string& difference : run.options)
      out += fmt::format("{}{}: other options: {}\n", markdown ? "- " : "", run.name, difference);
  if (!out.empty()) out += '\n';
  out += grid_text(scheme_grid(runs), markdown);
  const TextGrid frames = frame_grid(runs, per_frame);
  if (!frames.rows.empty()) out += grid_text(frames, markdown);
  std::string remarks;
  for (const RunComparison& run : runs)
    for (const std::string& remark : picture_remarks(run))
      remarks += fmt::format("{}{}: {}\n", markdown ? "- " : "", run.name, remark);
  return remarks.empty() ? out : out + "\n" + remarks;
}

std::vector<std::string> comparison_remarks(const RunComparison& run) {
  std::vector<std::string> out;
  for (const std::string& difference : run.options) out.push_back("other options: " + difference);
  for (std::string& remark : picture_remarks(run)) out.push_back(std::move(remark));
  return out;
}

}  // namespace tilepress
