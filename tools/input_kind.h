// Input kind: what a path holds, and the verb that takes it.
#pragma once

#include <string>
#include <string_view>

namespace tilepress {

/// "; tilepress replay takes traces", a hint behind the reason why a verb refuses the file or folder. The
/// first bytes decide, those of the first file in a folder that is known. Empty if nothing is known of the
/// path, or if its verb is `own`, that of the caller.
std::string verb_hint(const std::string& path, std::string_view own = "");

}  // namespace tilepress
