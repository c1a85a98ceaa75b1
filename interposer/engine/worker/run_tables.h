// Run tables: presents.csv and surfaces.csv, which only the shim writes.
#pragma once

#include <string>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/run/append_file.h"
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

}  // namespace tilepress
