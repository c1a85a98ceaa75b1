// Frame batch: runs the wanted frames of a sequence through the model, on one or several threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "frames/image_frames.h"
#include "tilepress/block_log.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// Takes the figures of a frame and its record for the block log. Returns false to end the batch.
using DeliverFrame = std::function<Result<bool>(const FrameStatistics&, const std::string& log_record)>;

/// Runs the frames `numbers` of `images` on up to `jobs` threads, and gives each to `deliver` in order, on the
/// calling thread. A frame depends on few frames before it. So the sequence is cut into ranges that run at the
/// same time, each after the frames that its first frame depends on: the results are the same for any number
/// of jobs. An error of a frame or of `deliver` ends the batch after all frames before it have been delivered.
/// Returns false if `stop` became nonzero or `deliver` returned false. The pictures that the options require
/// go below `pictures_path`, unless it is empty.
Result<bool> run_frame_batch(const ImageFrames& images, const std::vector<uint64_t>& numbers,
                             const RunOptions& options, const std::string& pictures_path,
                             const BlockLog& block_log, uint32_t jobs, const std::atomic<int>& stop,
                             const DeliverFrame& deliver);

}  // namespace tilepress
