// Statistics rows: frames.csv and schemes.csv, a row per frame and a row per scheme of a frame.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/csv_table.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// One row of schemes.csv.
struct SchemeRow {
  uint64_t frame = 0;
  uint32_t surface = 0;
  std::string_view scheme;  ///< the specification
  bool warmup = false;
  SchemeStatistics figures;
};

/// The columns of frames.csv.
std::span<const CsvColumn<FrameStatistics>> frame_columns();
/// The columns of schemes.csv: these, then the SchemeInfo::columns of the registry, then those of the
/// checks, then the added columns of the registry, then those of the toggles.
std::span<const CsvColumn<SchemeRow>> scheme_columns();
std::span<const CsvColumn<SchemeRow>> scheme_check_columns();
std::span<const CsvColumn<SchemeRow>> scheme_toggle_columns();

std::string frames_csv_header();
std::string schemes_csv_header();
void append_frames_row(const FrameStatistics& frame, std::string& out);
/// One row per scheme that was not skipped; scheme_names[i] is the specification of frame.schemes[i].
void append_schemes_rows(const FrameStatistics& frame, const std::vector<std::string>& scheme_names,
                         std::string& out);

}  // namespace tilepress
