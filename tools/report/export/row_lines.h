// Row lines: a run's CSV files as JSON lines, one object per row, cells as they are.
#pragma once

#include <string>

#include "streams/output_file.h"
#include "tilepress/result.h"

namespace tilepress {

/// Writes to `out`: run.json as {"type":"run",…}, each row of frames.csv as {"type":"frame",…} and each row
/// of schemes.csv as {"type":"scheme",…}. Each column stands under its name, numbers with their digits in the
/// file. All objects have "run": `name`.
Result<void> write_row_lines(const std::string& path, const std::string& name, OutputFile& out);

}  // namespace tilepress
