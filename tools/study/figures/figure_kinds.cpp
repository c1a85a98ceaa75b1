// Figure kinds: the table of kinds, and figures by it.
#include <fmt/format.h>

#include <algorithm>

#include "report/html_text.h"
#include "study/figures/figure_makers.h"

namespace tilepress {
namespace {

constexpr FigureKind kKinds[] = {
    {"metrics over time", metrics_over_time},
    {"colour CDF", color_cdf_figure},
    {"coverage against rate", coverage_against_rate},
    {"rate over an axis", rate_over_axis},
    {"relative coverage over an axis", relative_coverage_over_axis},
    {"rates of workloads", rates_of_workloads},
    {"means", means_of_categories},
    {"rate over bursts", rate_over_bursts},
    {"hybrid shares", hybrid_shares},
};

}  // namespace

std::span<const FigureKind> figure_kinds() {
  return kKinds;
}

Result<Figure> make_figure(const StudyData& data, const FigureSpec& spec) {
  if (spec.name.empty() || spec.name != file_slug(spec.name))
    return Error{ErrorKind::kBadValue,
                 fmt::format("figure '{}': a name has letters, digits, '.', '-' and '_' only", spec.name)};
  const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                 [&](const FigureKind& known) { return spec.kind == known.name; });
  if (kind == std::end(kKinds))
    return Error{ErrorKind::kBadValue,
                 fmt::format("figure {}: there is no kind of figure '{}'", spec.name, spec.kind)};
  auto figure = kind->make(data, spec);
  if (!figure) return about("figure " + spec.name, figure.error());
  if (figure->table.rows.empty())
    return Error{ErrorKind::kUnsupported,
                 fmt::format("figure {}: the study has no results for it", spec.name)};
  return figure;
}

}  // namespace tilepress
