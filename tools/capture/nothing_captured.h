// Nothing captured: explains why `tilepress run` has no frames.
#pragma once

#include <string>

#include "capture/program_launch.h"

namespace tilepress {

/// Writes what the shim looked for and what it saw. Returns the exit status. `program_path` is the program's
/// file.
int report_nothing_captured(const LaunchOptions& options, const SessionFolder& session, uint64_t frames_seen,
                            const std::string& program_path);

}  // namespace tilepress
