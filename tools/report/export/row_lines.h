// Row lines: a run's CSV files as JSON lines, one object per row, cells as they are.
#pragma once

#include <string>

#include "streams/output_file.h"

namespace tilepress {

/// Writes to `out`: run.json as {"type":"run",…}, each row of frames.csv as {"type":"frame",…} and each row
/// of schemes.csv as {"type":"scheme",…}, every column under its name, numbers with the digits they have in
/// the file. All objects have "run": `name`. False and one line in `error` on failure.
bool write_row_lines(const std::string& path, const std::string& name, OutputFile& out, std::string& error);

}  // namespace tilepress
