// Mesa manifest: the files traces-*.yml of Mesa's continuous integration, which piglit's replayer reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tilepress/trace_replay.h"

namespace tilepress {

/// True if the name ends in .yml or .yaml.
bool is_mesa_manifest(const std::string& path);

/// Reads the paths below `traces`, which is a mapping of paths to devices, or a list of entries with the key
/// `path`. The paths are relative to `trace_folder`, or to the manifest's folder if that is empty. A trace is
/// named by its path without extension, with "-" for each "/". Its category is empty. Devices and checksums
/// of images are not read. Files need not exist. Error: the manifest's path, and the line of a bad value.
Result<std::vector<ReplayInput>> read_mesa_manifest(const std::string& path, const std::string& trace_folder);

/// The text with "_" for each character that is not a letter, a digit or one of "._-+=": a name for files.
std::string plain_file_name(std::string_view text);

}  // namespace tilepress
