// Invocation: the call that made a study folder, kept there for `status`, `retry`, `merge` and other processes.
#pragma once

#include <string>

#include "study/study_options.h"

namespace tilepress {

/// Stores the study's text and the options in DIR/study.toml and DIR/invocation.json. What a process chooses for
/// itself (jobs, shard, progress) is left out, so that every shard writes the same bytes.
Result<void> store_invocation(const StudyOptions& options, const std::string& study_text);

/// Reads them back and loads the plugins. `study` becomes DIR/study.toml. Error: DIR holds no study, or a plugin
/// cannot be loaded.
Result<StudyOptions> load_invocation(const std::string& folder);

}  // namespace tilepress
