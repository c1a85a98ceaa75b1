// Present rows: the rows that the shim writes beside a run's statistics.
#pragma once

#include <cstdint>
#include <span>
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
std::span<const CsvColumn<PresentRow>> present_columns();

/// A surface in surfaces.csv.
struct SurfaceRow {
  uint32_t surface = 0;
  std::string_view role;    ///< "presented" or "target"
  std::string_view origin;  ///< "window", "texture 3"
  uint32_t width = 0, height = 0;
  std::string_view format;
  std::string_view color_space;  ///< "srgb" or "linear"
};
std::span<const CsvColumn<SurfaceRow>> surface_columns();

/// A present in a .times file: --measure-overhead writes a file per process.
struct PresentTimeRow {
  uint64_t window = 0;    ///< the program's handle
  uint64_t begin_ns = 0;  ///< of the call
  uint64_t hook_ns = 0;   ///< the call without the driver's part
};
std::span<const CsvColumn<PresentTimeRow>> present_time_columns();

}  // namespace tilepress
