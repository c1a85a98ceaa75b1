// Shim path: where the libraries lie that are preloaded, or loaded or run when needed.
#pragma once

#include <optional>
#include <string>

namespace tilepress {

/// Looks for `library`, or another part that lies beside the shim, relative to this executable: in an
/// installed tree (../lib, ../lib/tilepress) and in a build tree (../interposer). Absolute. `looked` receives
/// the places tried, for an error line.
std::optional<std::string> find_shim(const std::string& library, std::string& looked);

}  // namespace tilepress
