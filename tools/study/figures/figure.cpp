// Figure: its rows, the figures of a study, and their files' texts.
#include "study/figures/figure.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace tilepress {
std::vector<FigureSpec> figure_specs(const StudyData& data) {
  std::vector<FigureSpec> out = data.spec.figures;
  for (FigureSpec& spec : out) {
    for (PublishedPoint& point : spec.published) point.category = data.spelled_category(point.category);
    for (std::string& category : spec.categories) category = data.spelled_category(category);
  }
  if (!out.empty()) return out;
  for (const FigureAxis& axis : data.spec.axes)
    out.push_back({.name = axis.name,
                   .kind = "rate over an axis",
                   .title = (axis.title.empty() ? axis.name : axis.title) + " against rate",
                   .axis = axis.name});
  out.push_back({.name = "rates", .kind = "rates of workloads", .title = "Rates of the workloads"});
  out.push_back({.name = "means", .kind = "means", .title = "Harmonic means"});
  if (data.sensitivity.row_count() > 0)
    out.push_back({.name = "sensitivity", .kind = "rate over bursts", .title = "Rates at several DRAM bursts"});
  return out;
}

std::string figures_json(const StudyData& data, const std::vector<Figure>& figures) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Figure& figure : figures) {
    nlohmann::ordered_json published = nlohmann::ordered_json::array();
    for (const PublishedPoint& point : figure.spec.published)
      published.push_back({{"x", point.x}, {"category", point.category}, {"value", point.value}});
    list.push_back({{"name", figure.spec.name},
                    {"kind", figure.spec.kind},
                    {"title", figure.spec.title},
                    {"by_workload", figure.spec.by_workload},
                    {"x_column", figure.x_column},
                    {"y_column", figure.y_column},
                    {"x_label", figure.x_label},
                    {"y_label", figure.y_label},
                    {"x_scale", figure.x_scale},
                    {"x_order", figure.x_order},
                    {"share", figure.share},
                    {"published", published}});
  }
  nlohmann::ordered_json categories = nlohmann::ordered_json::array();
  for (const std::string& category : data.categories())
    categories.push_back({{"name", category}, {"title", data.category_title(category)}});
  return nlohmann::ordered_json{{"categories", categories}, {"figures", list}}.dump(1) + "\n";
}

}  // namespace tilepress
