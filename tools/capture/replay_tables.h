// Replay tables: the results of a batch of replays, for people and as CSV.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tilepress/replay_batch.h"

namespace tilepress {

/// Returns a line per trace with frames, time and the rate of each scheme, and a line per category with the
/// harmonic means.
std::string replay_table(const std::vector<std::unique_ptr<TraceReplay>>& replays);

/// Writes replay.csv (a row per trace and scheme) and categories.csv (a row per category and scheme) into
/// `folder`. Error: kFile, the file first.
Result<void> write_replay_csv(const std::string& folder,
                              const std::vector<std::unique_ptr<TraceReplay>>& replays);

}  // namespace tilepress
