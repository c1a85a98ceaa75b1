// Replay folder: where a replay works until its run is whole, and where the run then lies.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

class ReplayFolder {
 public:
  /// `output`: the folder of all replays, absolute. `name`: of this replay below it.
  ReplayFolder(const std::string& output, const std::string& name)
      : output_(output), run_path_(output + "/" + name), partial_path_(run_path_ + ".partial") {}

  const std::string& run_path() const { return run_path_; }
  const std::string& partial_path() const { return partial_path_; }
  bool exists() const;  ///< either of the two

  /// Makes the partial folder and its missing parents. Error: kFile, or kExists if the folder is there
  /// already. Replays of several threads may share parents.
  Result<void> make();
  /// Removes the partial folder; `with_parents` also the empty parents that make() made.
  void remove(bool with_parents);

 private:
  std::string output_, run_path_, partial_path_;
  std::vector<std::string> made_parents_;  ///< innermost first
};

}  // namespace tilepress
