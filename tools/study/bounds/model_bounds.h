// Model bounds: passes the frames of a workload through the coders of the bounds.
#pragma once

#include "study/model_frames.h"

namespace tilepress {

/// Fills ModelRows::schemes, one text per bound in the order of bound_names(); `frames` and `colors` stay
/// empty. Frames without 8-bit channels have no rows; `skipped` has a line per such surface. Otherwise as
/// model_frames().
Result<std::optional<ModelRows>> model_bounds(const FrameFeed& feed, const RunOptions& options,
                                              const std::atomic<int>& stop,
                                              std::atomic<uint64_t>& frames_done);

}  // namespace tilepress
