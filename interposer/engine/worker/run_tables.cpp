// Run tables: turns a frame into rows. The rows of .times files come from the presenting threads.
#include "interposer/engine/worker/run_tables.h"

#include <cstdlib>

#include "tilepress/present_rows.h"

namespace tilepress {
namespace {

constexpr const char* kWayNames[] = {"sync", "async", "both", "in-context"};  ///< by ReadWay

template <class Columns, class Row>
std::string line_of(const Columns& columns, const Row& row) {
  std::string line;
  append_csv_row(columns, row, line);
  return line;
}

}  // namespace

Result<void> RunTables::create(const std::string& path) {
  if (Result<void> made = presents_.create(path + "/presents.csv", csv_header(kPresentColumns)); !made)
    return made;
  return surfaces_.create(path + "/surfaces.csv", csv_header(kSurfaceColumns));
}

Result<void> RunTables::append_present(const CapturedFrame& frame) {
  return presents_.append(line_of(
      kPresentColumns, PresentRow{frame.frame, frame.surface, frame.readback_ns, frame.read_ns, frame.wait_ns,
                                  frame.damage, frame.bind_ns, frame.hand_off_ns, frame.interval_ns,
                                  frame.cause, kWayNames[static_cast<size_t>(frame.way)]}));
}

Result<void> RunTables::append_surface(const CapturedFrame& frame) {
  return surfaces_.append(line_of(
      kSurfaceColumns, SurfaceRow{frame.surface, frame.role == SurfaceRole::kTarget ? "target" : "presented",
                                  frame.origin, frame.view.width, frame.view.height,
                                  traits(frame.view.format).name, frame.srgb ? "srgb" : "linear"}));
}

PresentTimes::PresentTimes(int64_t pid) {
  const char* folder = std::getenv("TILEPRESS_PRESENT_TIMES");
  if (folder == nullptr || *folder == 0) return;
  const std::string stem = std::string(folder) + "/" + std::to_string(pid);
  const std::string header = csv_header(kPresentTimeColumns);
  std::string name = stem + ".times";
  // In another PID namespace a process may have the same number.
  Result<void> made = file_.create(name, header);
  for (int suffix = 2; !made && made.error().kind == ErrorKind::kExists; ++suffix) {
    name = stem + "-" + std::to_string(suffix) + ".times";
    made = file_.create(name, header);
  }
}

void PresentTimes::note(uintptr_t surface, uint64_t begin_ns, uint64_t hook_ns) {
  const std::string row = line_of(kPresentTimeColumns, PresentTimeRow{surface, begin_ns, hook_ns});
  const std::lock_guard lock(mutex_);
  (void)file_.append(row);
}

}  // namespace tilepress
