// Rate rows: the rates of traces or runs, scheme by scheme, and their means by category.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tilepress/csv_table.h"
#include "tilepress/replay_batch.h"

namespace tilepress {

/// A scheme of a trace, as replay.csv has it. A trace without a run has one row, without scheme.
struct RateRow {
  std::string trace, path, category;
  std::string status;  ///< "done", "kept", "failed", …
  uint64_t frames = 0, frames_wanted = 0, frames_captured = 0;
  double seconds = 0;  ///< of the replay
  std::string scheme;
  double rate_payload = 0, rate = 0;  ///< 0 without measured frames: an empty field

  /// Whether all frames were captured.
  bool is_whole() const { return status == "done" || status == "kept"; }
};
std::span<const CsvColumn<RateRow>> rate_columns();

/// In the order of the replays.
std::vector<RateRow> rate_rows(const std::vector<std::unique_ptr<TraceReplay>>& replays);
/// The rows of a run that is finished already.
std::vector<RateRow> rate_rows(const RunRecord& run, const std::string& name, const std::string& category);

/// Mean of one scheme over the traces of one category: harmonic, each trace counting the same.
struct CategoryMean {
  std::string category;  ///< empty: over all traces
  std::string scheme;
  uint64_t traces = 0;
  double rate = 0, rate_payload = 0;
};

/// Returns the means over the traces that are whole and have measured frames. Categories come in order of first
/// occurrence, and all traces together come last.
std::vector<CategoryMean> category_means(const std::vector<RateRow>& rows);

}  // namespace tilepress
