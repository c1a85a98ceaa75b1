// Plan text: what a study would do, without doing it.
#pragma once

#include <string>

#include "study/study_plan.h"

namespace tilepress {

/// A row per workload with frames, tasks and results that are there already, then totals and an estimate of the
/// time. Reads headers and traces, models a small picture to measure this machine, and renders nothing.
std::string plan_text(const StudyPlan& plan, const StudyOptions& options);

}  // namespace tilepress
