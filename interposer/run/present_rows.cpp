// Present rows: the columns of presents.csv, surfaces.csv and .times files.
#include "tilepress/present_rows.h"

namespace tilepress {

/// Runs of earlier versions lack the last columns.
constexpr bool kOptional = true;

constexpr CsvColumn<PresentRow> kPresentColumns[] = {
    csv_column<PresentRow, &PresentRow::frame>("frame"),
    csv_column<PresentRow, &PresentRow::surface>("surface"),
    csv_column<PresentRow, &PresentRow::readback_ns>("readback_ns", kOptional),
    csv_column<PresentRow, &PresentRow::read_ns>("read_ns", kOptional),
    csv_column<PresentRow, &PresentRow::wait_ns>("wait_ns", kOptional),
    csv_column<PresentRow, &PresentRow::damage>("damage", kOptional),
    csv_column<PresentRow, &PresentRow::bind_ns>("bind_ns", kOptional),
    csv_column<PresentRow, &PresentRow::hand_off_ns>("hand_off_ns", kOptional),
    csv_column<PresentRow, &PresentRow::interval_ns>("interval_ns", kOptional),
    csv_column<PresentRow, &PresentRow::cause>("cause", kOptional),
    csv_column<PresentRow, &PresentRow::readback>("readback", kOptional),
};

constexpr CsvColumn<SurfaceRow> kSurfaceColumns[] = {
    csv_column<SurfaceRow, &SurfaceRow::surface>("surface"),
    csv_column<SurfaceRow, &SurfaceRow::role>("role"),
    csv_column<SurfaceRow, &SurfaceRow::origin>("origin"),
    csv_column<SurfaceRow, &SurfaceRow::width>("width"),
    csv_column<SurfaceRow, &SurfaceRow::height>("height"),
    csv_column<SurfaceRow, &SurfaceRow::format>("format"),
    csv_column<SurfaceRow, &SurfaceRow::color_space>("color_space"),
};

constexpr CsvColumn<PresentTimeRow> kPresentTimeColumns[] = {
    csv_column<PresentTimeRow, &PresentTimeRow::window>("surface"),
    csv_column<PresentTimeRow, &PresentTimeRow::begin_ns>("begin_ns"),
    csv_column<PresentTimeRow, &PresentTimeRow::hook_ns>("hook_ns"),
};

std::span<const CsvColumn<PresentRow>> present_columns() {
  return kPresentColumns;
}
std::span<const CsvColumn<SurfaceRow>> surface_columns() {
  return kSurfaceColumns;
}
std::span<const CsvColumn<PresentTimeRow>> present_time_columns() {
  return kPresentTimeColumns;
}

}  // namespace tilepress
