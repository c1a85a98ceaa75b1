// Output folder: the folder of --output.
#pragma once

#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Returns `folder` as an absolute path without a slash at its end.
std::string absolute_folder(const std::string& folder);

/// Makes an output folder, and removes it at the end if it made it and nothing is in it.
class OutputFolder {
 public:
  OutputFolder() = default;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  /// `path` is absolute. Error: kFile, the path first, if nothing can be written there.
  Result<void> prepare(const std::string& path);

 private:
  std::string path_;
  bool made_ = false;
};

}  // namespace tilepress
