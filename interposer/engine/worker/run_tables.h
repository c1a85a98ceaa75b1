// Run tables: presents.csv, surfaces.csv and .times files, which only the shim writes.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>

#include "interposer/engine/readback/captured_frame.h"
#include "tilepress/append_file.h"
#include "tilepress/result.h"

namespace tilepress {

/// Each row is one write(): a kill loses no whole row. Not thread-safe.
class RunTables {
 public:
  /// Creates both files with their headers in the run folder `path`.
  Result<void> create(const std::string& path);
  Result<void> append_present(const CapturedFrame& frame);
  /// For the first frame of a surface.
  Result<void> append_surface(const CapturedFrame& frame);

 private:
  AppendFile presents_, surfaces_;
};

/// When each frame was presented and what the hook took, for `tilepress run --measure-overhead`.
/// Writes `<TILEPRESS_PRESENT_TIMES>/<pid>.times`, a row `surface,begin_ns,hook_ns` per presented frame. If
/// that file exists, the name is `<pid>-2.times` and so on. Off without the variable. Each row is one
/// write(), so a kill loses none.
class PresentTimes {
 public:
  explicit PresentTimes(int64_t pid);
  bool on() const { return file_.is_open(); }
  /// `begin_ns`: when the presenting call came in. `hook_ns`: the shim's part of its time. Thread-safe.
  void note(uintptr_t surface, uint64_t begin_ns, uint64_t hook_ns);

 private:
  std::mutex mutex_;
  AppendFile file_;
};

}  // namespace tilepress
