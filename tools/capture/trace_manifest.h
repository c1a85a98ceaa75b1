// Trace manifest: a file that lists traces, in TOML or in the YAML of Mesa.
#pragma once

#include <string>
#include <vector>

#include "tilepress/trace_replay.h"

namespace tilepress {

/// Folder name for a trace: its file name without ".trace".
std::string replay_name(const std::string& trace_path);

/// Reads `[[trace]]` tables with `path` (relative to the manifest) and the optional keys `name`, `sha256`,
/// `category` (UI, 2D or 3D) and `frames` ("0-99,200"). Error: kBadValue, the manifest's path and the line
/// first. The paths of a Mesa manifest (.yml, .yaml) are relative to `trace_folder` unless that is empty.
Result<std::vector<ReplayInput>> read_manifest(const std::string& path, const std::string& trace_folder = "");

}  // namespace tilepress
