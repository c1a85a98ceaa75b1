// Replaced runs: earlier replays that `replay --force` sets aside until the new ones are there.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Moves runs aside until end(), which the destructor calls too.
class ReplacedRuns {
 public:
  ReplacedRuns() = default;
  ReplacedRuns(const ReplacedRuns&) = delete;
  ReplacedRuns& operator=(const ReplacedRuns&) = delete;
  ~ReplacedRuns() { end(); }

  /// Moves the run in folder `path` aside, and removes what an interrupted replay left beside it. A folder
  /// that is not there is no error. Error: kFile, for a folder that holds no run.
  Result<void> set_aside(const std::string& path);
  /// Removes the runs that have a new one in their place, and moves the others back.
  void end();

 private:
  std::vector<std::string> paths_;
};

}  // namespace tilepress
