// Cache commands: what `tilepress study cache list` and `prune` do.
#pragma once

#include <cstdint>
#include <string>

namespace tilepress {

struct PruneOptions {
  uint64_t keep_bytes = 0;  ///< remove the least recently used files until no more than this is left
  bool dry_run = false;     ///< list what would go
};

/// Prints a row per cache file on standard output, the most recently used first. `folder`: empty for the
/// default. Returns the exit status.
int list_cache(const std::string& folder);

/// Removes cache files that no process renders or reads now, files that cannot be read, and what dead
/// processes left. Prints a line per file on standard output. Returns the exit status.
int prune_cache(const std::string& folder, const PruneOptions& options);

}  // namespace tilepress
