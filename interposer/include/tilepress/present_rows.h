// Present rows: the rows that the shim writes beside a run's statistics.
#pragma once

#include <cstdint>
#include <string_view>

#include "tilepress/csv_table.h"

namespace tilepress {

/// A captured frame in presents.csv. All times are in nanoseconds of the program's thread.
struct PresentRow {
  uint64_t frame = 0;
  uint32_t surface = 0;
  uint64_t readback_ns = 0;   ///< the whole capture
  uint64_t read_ns = 0;       ///< reading pixels, a part of readback_ns
  uint64_t wait_ns = 0;       ///< waiting for the queue
  std::string_view damage;    ///< "x y width height;…"; empty = everything
  uint64_t bind_ns = 0;       ///< making contexts current, a part of readback_ns
  uint64_t hand_off_ns = 0;   ///< handing the frame to the worker
  uint64_t interval_ns = 0;   ///< since the window's last present; 0 = its first
  std::string_view cause;     ///< "swap", "finish", …
  std::string_view readback;  ///< "sync", "async", …
};
/// Optional: runs of earlier versions lack these columns.
inline constexpr CsvColumn<PresentRow> kPresentColumns[] = {
    csv_column<PresentRow, &PresentRow::frame>("frame"),
    csv_column<PresentRow, &PresentRow::surface>("surface"),
    csv_column<PresentRow, &PresentRow::readback_ns>("readback_ns", true),
    csv_column<PresentRow, &PresentRow::read_ns>("read_ns", true),
    csv_column<PresentRow, &PresentRow::wait_ns>("wait_ns", true),
    csv_column<PresentRow, &PresentRow::damage>("damage", true),
    csv_column<PresentRow, &PresentRow::bind_ns>("bind_ns", true),
    csv_column<PresentRow, &PresentRow::hand_off_ns>("hand_off_ns", true),
    csv_column<PresentRow, &PresentRow::interval_ns>("interval_ns", true),
    csv_column<PresentRow, &PresentRow::cause>("cause", true),
    csv_column<PresentRow, &PresentRow::readback>("readback", true),
};

/// A surface in surfaces.csv.
struct SurfaceRow {
  uint32_t surface = 0;
  std::string_view role;    ///< "presented" or "target"
  std::string_view origin;  ///< "window", "texture 3"
  uint32_t width = 0, height = 0;
  std::string_view format;
  std::string_view color_space;  ///< "srgb" or "linear"
};
inline constexpr CsvColumn<SurfaceRow> kSurfaceColumns[] = {
    csv_column<SurfaceRow, &SurfaceRow::surface>("surface"),
    csv_column<SurfaceRow, &SurfaceRow::role>("role"),
    csv_column<SurfaceRow, &SurfaceRow::origin>("origin"),
    csv_column<SurfaceRow, &SurfaceRow::width>("width"),
    csv_column<SurfaceRow, &SurfaceRow::height>("height"),
    csv_column<SurfaceRow, &SurfaceRow::format>("format"),
    csv_column<SurfaceRow, &SurfaceRow::color_space>("color_space"),
};

/// A present in a .times file: --measure-overhead writes a file per process.
struct PresentTimeRow {
  uint64_t window = 0;    ///< the program's handle
  uint64_t begin_ns = 0;  ///< of the call
  uint64_t hook_ns = 0;   ///< the call without the driver's part
};
inline constexpr CsvColumn<PresentTimeRow> kPresentTimeColumns[] = {
    csv_column<PresentTimeRow, &PresentTimeRow::window>("surface"),
    csv_column<PresentTimeRow, &PresentTimeRow::begin_ns>("begin_ns"),
    csv_column<PresentTimeRow, &PresentTimeRow::hook_ns>("hook_ns"),
};

}  // namespace tilepress
