// Trace manifest: a TOML file that lists traces with checksum, category and frame range.
#pragma once

#include <string>
#include <vector>

#include "tilepress/trace_replay.h"

namespace tilepress {

/// Folder name for a trace: its file name without ".trace".
std::string replay_name(const std::string& trace_path);

/// Reads `[[trace]]` tables with `path` (relative to the manifest) and, if wanted, `name`, `sha256`,
/// `category` (UI, 2D or 3D) and `frames` ("0-99,200"), and appends them. False and one line in `error`, path
/// and line first, at anything else.
bool read_manifest(const std::string& path, std::vector<ReplayInput>& inputs, std::string& error);

}  // namespace tilepress
