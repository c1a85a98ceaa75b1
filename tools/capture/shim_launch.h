// Shim launch: the library and the environment that bring the shim into a program.
#pragma once

#include <map>
#include <string>

#include "capture/session_folder.h"
#include "temporary_folder.h"
#include "tilepress/run_options.h"
#include "tilepress/shim_environment.h"

namespace tilepress {

/// Returns a path to the shim that LD_PRELOAD can take; a link to it goes into `links` if necessary.
/// `all_targets` chooses the library that exports the functions which --targets all watches.
Result<std::string> preloadable_shim(bool all_targets, TemporaryFolder& links);

/// Returns the variables that make a program run under the shim with `options` and note what it sees in
/// `session`. `library` is a result of preloadable_shim().
Result<std::map<std::string, std::string>> shim_variables(const RunOptions& options,
                                                          const SessionFolder& session, ShimRoad road,
                                                          const std::string& library);

}  // namespace tilepress
