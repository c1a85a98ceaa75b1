// Host name: which machine of a shared folder this is.
#pragma once

#include <string>

namespace tilepress {

/// The name without characters that file names lack; "host" if unknown.
std::string host_name();

}  // namespace tilepress
