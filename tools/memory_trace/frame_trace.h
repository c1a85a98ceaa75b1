// Frame trace: writes the memory trace of a sequence of frames: each is written and then shown once.
#pragma once

#include <string>

#include "memory_trace/memory_trace.h"
#include "memory_trace/traced_frames.h"
#include "progress_line.h"

namespace tilepress {

/// Writes the trace of `frames` to `path`, and returns a line about it. Frames are a refresh apart: the frames
/// of several surfaces share one until a surface presents its next. With has_times() and without a refresh in
/// `options` they are presented when the program did. The writes of a frame fill the time before its present,
/// and its reads the time after it: a refresh, or less if the surface's frames come faster.
Result<std::string> write_frame_trace(const std::string& path, const MemoryTraceOptions& options,
                                      TracedFrames& frames, ProgressMode progress);

}  // namespace tilepress
