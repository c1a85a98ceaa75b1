// Present times: rows appended from the presenting threads.
#include "interposer/engine/present_times.h"

#include <cstdlib>
#include <string>

#include "tilepress/present_rows.h"

namespace tilepress {

PresentTimes::PresentTimes(int64_t pid) {
  const char* folder = std::getenv("TILEPRESS_PRESENT_TIMES");
  if (folder == nullptr || *folder == 0) return;
  const std::string stem = std::string(folder) + "/" + std::to_string(pid);
  const std::string header = csv_header(present_time_columns());
  std::string name = stem + ".times";
  // In another PID namespace a process may have the same number.
  Result<void> made = file_.create(name, header);
  for (int suffix = 2; !made && made.error().kind == ErrorKind::kExists; ++suffix) {
    name = stem + "-" + std::to_string(suffix) + ".times";
    made = file_.create(name, header);
  }
}

void PresentTimes::note(uintptr_t surface, uint64_t begin_ns, uint64_t hook_ns) {
  std::string row;
  append_csv_row(present_time_columns(), PresentTimeRow{surface, begin_ns, hook_ns}, row);
  const std::lock_guard lock(mutex_);
  (void)file_.append(row);
}

}  // namespace tilepress
