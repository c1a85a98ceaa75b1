// Shared folder: folders that programs of several users write, in several namespaces at once.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Lets those who may write the parent of `folder` write `folder` too: gives it the parent's mode and, as far
/// as the system allows, the parent's owner and group. `extra_mode` is added to the mode.
void share_like_parent(const std::string& folder, unsigned extra_mode = 0);

/// Makes the folder `name`, `name`-2, `name`-3, … inside `output`: the first name that is free. Two processes
/// never get the same one, even with equal pids. A process of root shares the folder like its parent, because
/// it may change its user before the next frame. Returns the path.
Result<std::string> make_run_folder(const std::string& output, const std::string& name);

}  // namespace tilepress
