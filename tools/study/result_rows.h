// Result rows: sums over the rows of schemes.csv of one workload and configuration.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// The columns that single schemes add to schemes.csv, such as vdcp_blocks: of all schemes, each once.
std::vector<std::string_view> own_column_names();

/// A mean over the frames that have a value.
struct MeanOverFrames {
  double sum = 0;
  uint64_t frames = 0;
  void add(double value) { sum += value, ++frames; }
  std::optional<double> mean() const {
    return frames > 0 ? std::optional(sum / static_cast<double>(frames)) : std::nullopt;
  }
};

/// A frame of a configuration.
struct ResultFrame {
  uint64_t frame = 0;
  uint32_t surface = 0;
  double rate = 0, rate_payload = 0;
  std::optional<double> fvc_coverage;
};

/// Sums over presented frames of all surfaces, without warm-up.
struct ResultSums {
  uint64_t frames = 0;
  SchemeStatistics total;
  MeanOverFrames fvc_coverage, fvc_relative_coverage;
  /// In the order of own_column_names(). Nothing where the scheme has no such column, or the file lacks it.
  std::vector<std::optional<uint64_t>> own;
  std::vector<ResultFrame> each;  ///< of these frames, if wanted
};

/// Reads `text`, a schemes.csv with the rows of one configuration. Error: kFile, the record first.
Result<ResultSums> sum_result_rows(std::string_view text, uint32_t burst_bits, bool with_frames);

}  // namespace tilepress
