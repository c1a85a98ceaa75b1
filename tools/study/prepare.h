// Prepare: brings a workload's frames to where tasks read them.
#pragma once

#include <atomic>

#include "study/frame_feed.h"
#include "study/inputs.h"
#include "study/study_file.h"
#include "study/study_options.h"
#include "study/study_records.h"

namespace tilepress {

struct PreparedWorkload {
  WorkloadRecord record;  ///< its state says whether there are frames or results
  OpenFeed open;          ///< null without frames
  uint64_t pixels = 0;    ///< of all frames; 0 = not known
  bool rendered = false;  ///< by this call
  double render_seconds = 0;
};

/// Renders a trace into the frame cache or finds it there, computes digests, and copies the rows of a finished
/// run into the result store. An input that fails gives a record with state and reason. Thread-safe.
PreparedWorkload prepare_workload(const Workload& workload, const StudyFile& study, const StudyOptions& options,
                                  const std::atomic<int>& stop);

}  // namespace tilepress
