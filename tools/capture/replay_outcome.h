// Replay outcome: what a finished or interrupted batch of replays reports on standard error.
#pragma once

#include <string>
#include <vector>

#include "tilepress/replay_batch.h"

namespace tilepress {

/// Says which replays are done, cut off and not begun after a signal. Empty if every replay had ended before
/// it.
std::string interruption_text(const ReplayBatch& batch);

/// Writes one message per failed trace, and the last lines of its retracer. Returns the exit status. Traces
/// in `named` have their message already.
int report_failures(const ReplayBatch& batch, const std::vector<std::string>& named);

/// Converts the dumped frames of every run to PNG. Returns false after a message for each run that failed.
bool convert_all_dumped_frames(const ReplayBatch& batch);

}  // namespace tilepress
