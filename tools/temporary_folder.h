// Temporary folder: private, in TMPDIR or /tmp, removed with the object.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

class TemporaryFolder {
 public:
  TemporaryFolder() = default;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  /// Makes the folder. Its path has neither spaces nor colons.
  Result<void> create();
  /// Empty before create().
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// LD_PRELOAD separates paths by spaces and colons. Returns a path to `library` without them. If `library` has
/// some, the path leads through a link in `folder`, which is made for it.
Result<std::string> preloadable(const std::string& library, TemporaryFolder& folder);

}  // namespace tilepress
