// Run JSON: writes and reads run.json.
#pragma once

#include <string>
#include <string_view>

#include "tilepress/run_reader.h"

namespace tilepress {

constexpr int kRunSchemaVersion = 1;

/// `record` needs no frames.
std::string run_json_text(const RunRecord& record, const RunOptions& options);

/// Fills `record` from `text`. Members that `text` lacks stay as they are. Fails if `text` is no JSON object.
Result<void> read_run_json(std::string_view text, RunRecord& record);

/// Returns `text` with the state, counts and totals of `record`, and with `end`. Returns a new document if
/// `text` is no JSON.
std::string finished_run_json(std::string_view text, const RunRecord& record, const RunEnd& end);

}  // namespace tilepress
