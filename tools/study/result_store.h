// Result store: the rows of each workload and configuration, in files named after what the rows depend on.
#pragma once

#include <string>

#include "tilepress/run_options.h"

namespace tilepress {

/// Names files below `folder`/results. A name holds a digest of the frames, the configuration, the options
/// that change rows, and the version of the files' format: a file that exists is never computed again.
class ResultStore {
 public:
  ResultStore(const std::string& folder, const RunOptions& options) : folder_(folder), options_(options) {}

  /// SHA-256 of all that the rows of a configuration depend on.
  std::string result_key(const std::string& frames_digest, const SchemeSpec& spec) const;
  /// The rows of schemes.csv of one configuration.
  std::string result_path(const std::string& workload, const std::string& frames_digest,
                          const SchemeSpec& spec) const;
  /// The rows of a bound, in the columns of schemes.csv.
  std::string bound_path(const std::string& workload, const std::string& frames_digest,
                         const std::string& bound) const;
  /// The rows of frames.csv.
  std::string frames_path(const std::string& workload, const std::string& frames_digest) const;
  /// The share of pixels that the most frequent colours cover.
  std::string colors_path(const std::string& workload, const std::string& frames_digest) const;

 private:
  /// A key for rows that depend on the frames, which of them are modelled, and `further`.
  std::string frames_key(const std::string& frames_digest, const std::string& further) const;
  std::string metrics_key(const std::string& frames_digest) const { return frames_key(frames_digest, "metrics "); }
  std::string folder_of(const std::string& workload) const { return folder_ + "/results/" + workload + "/"; }
  std::string folder_;
  RunOptions options_;
};

}  // namespace tilepress
