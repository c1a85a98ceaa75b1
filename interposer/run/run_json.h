// Run JSON: writes and reads run.json.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tilepress/run_info.h"
#include "tilepress/run_reader.h"

namespace tilepress {

constexpr int kRunSchemaVersion = 1;

/// All that run.json holds.
struct RunDocument {
  std::string state = "running";
  std::string reason;
  std::string started;  ///< UTC, ISO 8601
  RunInfo info;
  RunOptions options;
  RunCounts counts;
  uint64_t measured_frames = 0;
  std::vector<SchemeStatistics> totals;  ///< in the order of options.schemes
  RunCounts target_counts;
  uint64_t measured_targets = 0;
  std::vector<SchemeStatistics> target_totals;
};

std::string run_json_text(const RunDocument& document);

/// Fills `record` from `text`. Members that `text` lacks stay as they are. Fails if `text` is no JSON object.
Result<void> read_run_json(std::string_view text, RunRecord& record);

/// Returns `text` with the state, counts and totals of `record`, and with `end`. Returns a new document if
/// `text` is no JSON.
std::string finished_run_json(std::string_view text, const RunRecord& record, const RunEnd& end);

/// The current time in UTC, ISO 8601, in seconds.
std::string utc_now();

}  // namespace tilepress
