// Replay tables: the results of a batch, as text and as CSV files.
#pragma once

#include <string>
#include <vector>

#include "capture/rate_rows.h"

namespace tilepress {

/// A row per trace with its rates, then harmonic means by category. "(!)" marks traces that are not whole. `unit`:
/// what a row is of, "trace" or "run".
std::string rate_table(const std::vector<RateRow>& rows, const std::string& unit);

/// Writes replay.csv (a row per trace and scheme) and categories.csv (harmonic means). Rows of other traces that
/// are in `folder` already stay and count in the means: several processes can replay parts of a batch into one
/// folder.
Result<void> write_replay_csv(const std::string& folder, std::vector<RateRow> rows);

}  // namespace tilepress
