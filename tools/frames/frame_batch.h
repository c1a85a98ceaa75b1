// Frame batch: runs the wanted frames of a sequence through the model, on several threads if asked.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "frames/image_frames.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// Runs the frames `numbers` of `images`, on up to `jobs` threads, and hands each to `deliver` in order, on
/// the calling thread. A frame depends on few frames before it, so the sequence is cut into ranges that run
/// at once, each preceded by the frames its first one depends on: the results are the same for any number of
/// jobs. False and one line in `error` if a frame cannot be read or `deliver` returns false; the frames
/// before it have been delivered. False without a line once `stop` is not 0. The pictures that the options
/// ask for go below `pictures_path`, unless it is empty.
bool run_frame_batch(const ImageFrames& images, const std::vector<uint64_t>& numbers,
                     const RunOptions& options, const std::string& pictures_path, uint32_t jobs,
                     const std::atomic<int>& stop, const std::function<bool(const FrameStatistics&)>& deliver,
                     std::string& error);

}  // namespace tilepress
