// Run tables: turns a frame into rows of the run's own tables.
#include "interposer/engine/worker/run_tables.h"

#include "tilepress/present_rows.h"

namespace tilepress {
namespace {

const char* name_of(ReadWay way) {
  switch (way) {
    case ReadWay::kAsync:
      return "async";
    case ReadWay::kBoth:
      return "both";
    case ReadWay::kInContext:
      return "in-context";
    default:
      return "sync";
  }
}

template <class Columns, class Row>
std::string line_of(const Columns& columns, const Row& row) {
  std::string line;
  append_csv_row(columns, row, line);
  return line;
}

}  // namespace

Result<void> RunTables::create(const std::string& path) {
  if (Result<void> made = presents_.create(path + "/presents.csv", csv_header(present_columns())); !made)
    return made;
  return surfaces_.create(path + "/surfaces.csv", csv_header(surface_columns()));
}

Result<void> RunTables::append_present(const CapturedFrame& frame) {
  return presents_.append(line_of(
      present_columns(),
      PresentRow{frame.frame, frame.surface, frame.readback_ns, frame.read_ns, frame.wait_ns, frame.damage,
                 frame.bind_ns, frame.hand_off_ns, frame.interval_ns, frame.cause, name_of(frame.way)}));
}

Result<void> RunTables::append_surface(const CapturedFrame& frame) {
  return surfaces_.append(
      line_of(surface_columns(),
              SurfaceRow{frame.surface, frame.role == SurfaceRole::kTarget ? "target" : "presented",
                         frame.origin, frame.view.width, frame.view.height, traits(frame.view.format).name,
                         frame.srgb ? "srgb" : "linear"}));
}

}  // namespace tilepress
