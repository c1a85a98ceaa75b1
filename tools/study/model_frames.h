// Model frames: passes the frames of a workload through several configurations at once.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "study/frame_feed.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"

namespace tilepress {

struct ModelRows {
  std::vector<std::string> schemes;  ///< per configuration: schemes.csv with the rows of that one
  std::string frames;                ///< frames.csv
  std::string colors;                ///< ColorShares::text()
  uint64_t frame_count = 0;
  std::vector<std::string>
      skipped;  ///< a line per scheme and surface whose format the scheme does not support
};

/// Appends the row of frame.schemes[i], under names[i], to texts[i].
void append_texts_of_schemes(const FrameStatistics& frame, const std::vector<std::string>& names,
                             std::vector<std::string>& texts);

/// Models the frames that `options` select with `options.schemes`. `with_colors` fills `colors`. Adds to
/// `frames_done` after each frame. Returns nothing once `stop` is not 0.
Result<std::optional<ModelRows>> model_frames(const FrameFeed& feed, const RunOptions& options,
                                              bool with_colors, const std::atomic<int>& stop,
                                              std::atomic<uint64_t>& frames_done);

}  // namespace tilepress
