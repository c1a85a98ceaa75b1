// Statistics rows: the columns of frames.csv and schemes.csv.
#include <algorithm>

#include "tilepress/scheme.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

using Frame = FrameStatistics;

#define TP_MEMBER(path)    \
  [](auto& row) -> auto& { \
    return row.path;       \
  }

/// A figure of the scheme's FVC; empty if the frame has none.
template <double FvcFigures::*figure>
constexpr CsvColumn<SchemeRow> fvc_column(std::string_view name) {
  return {name,
          [](const SchemeRow& row, std::string& out) {
            if (row.figures.fvc) append_csv(out, (*row.figures.fvc).*figure);
          },
          [](std::string_view field, SchemeRow& row) {
            if (!row.figures.fvc) row.figures.fvc.emplace();
            return read_csv(field, (*row.figures.fvc).*figure);
          },
          true};
}

/// A count of toggles; empty if none were counted.
template <uint64_t ToggleCounts::*count>
constexpr CsvColumn<SchemeRow> toggle_column(std::string_view name) {
  return {name,
          [](const SchemeRow& row, std::string& out) {
            if (row.figures.toggles) append_csv(out, (*row.figures.toggles).*count);
          },
          [](std::string_view field, SchemeRow& row) {
            if (!row.figures.toggles) row.figures.toggles.emplace();
            return read_csv(field, (*row.figures.toggles).*count);
          },
          true};
}

constexpr CsvColumn<Frame> kFormatColumn = {
    "format", [](const Frame& frame, std::string& out) { out += traits(frame.format).name; },
    [](std::string_view field, Frame& frame) {
      const auto* found = std::ranges::find(kFormatTraits, field, &FormatTraits::name);
      if (found == std::end(kFormatTraits)) return false;
      frame.format = static_cast<PixelFormat>(found - std::begin(kFormatTraits));
      return true;
    }};

constexpr CsvColumn<Frame> kFrameColumns[] = {
    csv_column<Frame, &Frame::frame>("frame"),
    csv_column<Frame, &Frame::surface>("surface"),
    csv_column<Frame, &Frame::width>("width"),
    csv_column<Frame, &Frame::height>("height"),
    kFormatColumn,
    csv_column<Frame, &Frame::warmup>("warmup"),
    csv_column<Frame, &Frame::time_ns>("time_ns"),
    csv_column<Frame, TP_MEMBER(metrics.unique_colors)>("unique_colors"),
    csv_column<Frame, TP_MEMBER(metrics.entropy)>("entropy"),
    csv_column<Frame, TP_MEMBER(metrics.pixel_change)>("pixel_change"),
    csv_column<Frame, TP_MEMBER(metrics.color_change)>("color_change"),
    csv_column<Frame, TP_MEMBER(metrics.fvc_coverage)>("fvc_coverage"),
    csv_column<Frame, TP_MEMBER(metrics.fvc_relative_coverage)>("fvc_relative_coverage"),
    csv_column<Frame, TP_MEMBER(metrics.top100_coverage)>("top100_coverage"),
    csv_column<Frame, &Frame::readback_ns>("readback_ns"),
    csv_column<Frame, &Frame::encode_ns>("encode_ns"),
};

constexpr CsvColumn<SchemeRow> kSchemeColumns[] = {
    csv_column<SchemeRow, &SchemeRow::frame>("frame"),
    csv_column<SchemeRow, &SchemeRow::surface>("surface"),
    csv_column<SchemeRow, &SchemeRow::scheme>("scheme"),
    csv_column<SchemeRow, &SchemeRow::warmup>("warmup"),
    csv_column<SchemeRow, TP_MEMBER(figures.blocks)>("blocks"),
    csv_column<SchemeRow, TP_MEMBER(figures.raw_bits)>("raw_bits"),
    csv_column<SchemeRow, TP_MEMBER(figures.payload_bits)>("payload_bits"),
    csv_column<SchemeRow, TP_MEMBER(figures.bursts)>("bursts"),
    csv_column<SchemeRow, TP_MEMBER(figures.csb_bits)>("csb_bits"),
    csv_column<SchemeRow, TP_MEMBER(figures.palette_bits)>("palette_bits"),
    csv_figure<SchemeRow, [](const SchemeRow& row) { return row.figures.rate_payload(); }>("rate_payload"),
    csv_figure<SchemeRow, [](const SchemeRow& row) { return row.figures.rate(); }>("rate"),
    csv_column<SchemeRow, TP_MEMBER(figures.extra_bits)>("extra_bits", true),
};

constexpr CsvColumn<SchemeRow> kSchemeCheckColumns[] = {
    csv_column<SchemeRow, TP_MEMBER(figures.checked_blocks)>("checked_blocks", true),
    csv_column<SchemeRow, TP_MEMBER(figures.mismatched_blocks)>("mismatched_blocks", true),
    csv_figure<SchemeRow, [](const SchemeRow& row) { return row.figures.rate_with_extra(); }>(
        "rate_with_extra"),
    fvc_column<&FvcFigures::coverage>("fvc_coverage"),
    fvc_column<&FvcFigures::relative_coverage>("fvc_relative_coverage"),
};

constexpr CsvColumn<SchemeRow> kSchemeToggleColumns[] = {
    toggle_column<&ToggleCounts::plain>("toggles"),
    toggle_column<&ToggleCounts::inverted>("toggles_dbi"),
    toggle_column<&ToggleCounts::raw_plain>("raw_toggles"),
    toggle_column<&ToggleCounts::raw_inverted>("raw_toggles_dbi"),
};

#undef TP_MEMBER

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_number(double value) {
  std::string out;
  append_csv(out, value);
  return out;
}

std::span<const CsvColumn<FrameStatistics>> frame_columns() {
  return kFrameColumns;
}
std::span<const CsvColumn<SchemeRow>> scheme_columns() {
  return kSchemeColumns;
}
std::span<const CsvColumn<SchemeRow>> scheme_check_columns() {
  return kSchemeCheckColumns;
}

std::span<const CsvColumn<SchemeRow>> scheme_toggle_columns() {
  return kSchemeToggleColumns;
}

std::string frames_csv_header() {
  return csv_header(kFrameColumns);
}

std::string schemes_csv_header() {
  std::string header;
  append_csv_names(kSchemeColumns, header);
  for (const SchemeInfo& info : scheme_registry())
    for (const char* column : info.columns) (header += ',') += column;
  append_csv_names(kSchemeCheckColumns, header += ',');
  for (const SchemeInfo& info : scheme_registry())
    for (const char* column : info.added_columns) (header += ',') += column;
  append_csv_names(kSchemeToggleColumns, header += ',');
  return header += '\n';
}

void append_frames_row(const FrameStatistics& frame, std::string& out) {
  append_csv_row(kFrameColumns, frame, out);
}

void append_schemes_rows(const FrameStatistics& frame, const std::vector<std::string>& scheme_names,
                         std::string& out) {
  for (size_t i = 0; i < frame.schemes.size(); ++i) {
    if (frame.schemes[i].skipped) continue;
    const SchemeRow row{frame.frame, frame.surface, scheme_names[i], frame.warmup, frame.schemes[i]};
    append_csv_fields(kSchemeColumns, row, out);
    const std::string_view name = row.scheme.substr(0, row.scheme.find(':'));
    const auto append_own = [&](const SchemeInfo& info, size_t first, size_t count) {
      for (size_t column = first; column < first + count; ++column)
        append_csv(out += ',', name == info.name ? row.figures.own[column] : 0);
    };
    for (const SchemeInfo& info : scheme_registry()) append_own(info, 0, info.columns.size());
    append_csv_fields(kSchemeCheckColumns, row, out += ',');
    for (const SchemeInfo& info : scheme_registry())
      append_own(info, info.columns.size(), info.added_columns.size());
    append_csv_fields(kSchemeToggleColumns, row, out += ',');
    out += '\n';
  }
}

}  // namespace tilepress
