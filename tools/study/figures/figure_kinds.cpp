// Figure kinds: the table of kinds, and figures and their charts by it.
#include <fmt/format.h>

#include <algorithm>

#include "report/html_text.h"
#include "study/figures/figure_makers.h"
#include "study/figures/page_figures.h"

namespace tilepress {
namespace {

/// One kind of figure that a study file may name.
struct FigureKind {
  const char* name;
  Result<Figure> (*make)(const StudyData& data, const FigureSpec& spec);
  PageChart (*chart)(const StudyData& data, const Figure& figure);
};
constexpr FigureKind kKinds[] = {
    {"metrics over time", metrics_over_time, change_lines},
    {"colour CDF", color_cdf_figure, cdf_lines},
    {"coverage against rate", coverage_against_rate, coverage_scatter},
    {"rate over an axis", rate_over_axis, axis_chart},
    {"relative coverage over an axis", relative_coverage_over_axis, axis_chart},
    {"rates of workloads", rates_of_workloads, rate_dots},
    {"means", means_of_categories, mean_bars},
    {"rate over bursts", rate_over_bursts, burst_dots},
    {"hybrid shares", hybrid_shares, share_stacks},
};

/// Null for an unknown kind.
const FigureKind* find_kind(const std::string& name) {
  const auto found = std::ranges::find(kKinds, name, &FigureKind::name);
  return found == std::end(kKinds) ? nullptr : found;
}

}  // namespace

Result<Figure> make_figure(const StudyData& data, const FigureSpec& spec) {
  if (spec.name.empty() || spec.name != file_slug(spec.name))
    return Error{ErrorKind::kBadValue,
                 fmt::format("figure '{}': a name has letters, digits, '.', '-' and '_' only", spec.name)};
  const FigureKind* kind = find_kind(spec.kind);
  if (kind == nullptr)
    return Error{ErrorKind::kBadValue,
                 fmt::format("figure {}: there is no kind of figure '{}'", spec.name, spec.kind)};
  auto figure = kind->make(data, spec);
  if (!figure) return about("figure " + spec.name, figure.error());
  if (figure->table.rows.empty())
    return Error{ErrorKind::kUnsupported,
                 fmt::format("figure {}: the study has no results for it", spec.name)};
  return figure;
}

PageChart page_chart(const StudyData& data, const Figure& figure) {
  return find_kind(figure.spec.kind)->chart(data, figure);
}

}  // namespace tilepress
