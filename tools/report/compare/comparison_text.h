// Comparison text: a batch of comparisons as text for a terminal, as Markdown or as CSV.
#pragma once

#include <string>
#include <vector>

#include "report/compare/run_comparison.h"

namespace tilepress {

enum class ComparisonFormat { kText, kMarkdown, kCsv };

/// A table of the schemes' rates per run. Text and Markdown also have a table of frames: with `per_frame` all
/// frames, else the kWorstFrames frames of each scheme whose rates differ most. CSV has only scheme rows, or
/// with `per_frame` only frame rows.
std::string comparison_text(const std::vector<RunComparison>& runs, ComparisonFormat format, bool per_frame);

constexpr size_t kWorstFrames = 3;

/// One line for each difference of the two runs other than rates.
std::vector<std::string> comparison_remarks(const RunComparison& run);

}  // namespace tilepress
