// Comparison text: a batch of comparisons as text for a terminal, as Markdown or as CSV.
#pragma once

#include <string>
#include <vector>

#include "report/compare/run_comparison.h"

namespace tilepress {

enum class ComparisonFormat { kText, kMarkdown, kCsv };

/// A table of the schemes' rates per run. With `per_frame` also every frame, otherwise (text and Markdown)
/// the `kWorstFrames` frames of each scheme whose rates differ most. CSV has one kind of row only: scheme
/// rows, or frame rows with `per_frame`.
std::string comparison_text(const std::vector<RunComparison>& runs, ComparisonFormat format, bool per_frame);

constexpr size_t kWorstFrames = 3;

/// One line for each thing that keeps `run` from being a comparison of equals; empty if there is none.
std::vector<std::string> comparison_remarks(const RunComparison& run);

}  // namespace tilepress
