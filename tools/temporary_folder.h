// Temporary folder: private, in TMPDIR or /tmp, removed with the object.
#pragma once

#include <string>

namespace tilepress {

class TemporaryFolder {
 public:
  TemporaryFolder() = default;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  /// Makes the folder. Its path has neither spaces nor colons. Returns false and one line in `error` on
  /// failure.
  bool create(std::string& error);
  /// Empty before create().
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// LD_PRELOAD separates paths by spaces and colons. Returns a path to `library` that has neither, through a
/// link in `folder` if need be; the folder is made then. Returns an empty path and one line in `error` on
/// failure.
std::string preloadable(const std::string& library, TemporaryFolder& folder, std::string& error);

}  // namespace tilepress
