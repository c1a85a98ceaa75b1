// Result store: the rows of each workload and configuration, in files named after what the rows depend on.
#pragma once

#include <string>

#include "tilepress/run_options.h"

namespace tilepress {

/// Names the files of a workload below `folder`/results. A name holds a digest of the frames, the
/// configuration, the options that change rows, and the version of the files' format: a file that exists is
/// never computed again.
class ResultStore {
 public:
  ResultStore(const std::string& folder, const RunOptions& options, const std::string& workload,
              const std::string& frames_digest)
      : folder_(folder + "/results/" + workload + "/"), frames_digest_(frames_digest), options_(options) {}

  /// SHA-256 of all that the rows of a configuration depend on.
  std::string result_key(const SchemeSpec& spec) const;
  /// The rows of schemes.csv of one configuration.
  std::string result_path(const SchemeSpec& spec) const;
  /// The rows of a bound, in the columns of schemes.csv.
  std::string bound_path(const std::string& bound) const;
  /// The rows of frames.csv.
  std::string frames_path() const { return folder_ + "frames-" + frames_key("metrics ") + ".csv"; }
  /// The share of pixels that the most frequent colours cover.
  std::string colors_path() const { return folder_ + "colors-" + frames_key("metrics ") + ".csv"; }

 private:
  /// A key for rows that depend on the frames, which of them are modelled, and `further`.
  std::string frames_key(const std::string& further) const;
  std::string folder_, frames_digest_;
  RunOptions options_;
};

}  // namespace tilepress
