// Page parts: order of the batch and the markup around charts and tables.
#include "page_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "counted.h"
#include "scheme_names.h"

namespace tilepress {
namespace {

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The paper's order, then the other categories by name, then runs without a category.
std::pair<int, std::string> category_order(const std::string& category) {
  const std::string name = lower(category);
  if (name == "ui") return {0, name};
  if (name == "2d") return {1, name};
  if (name == "3d") return {2, name};
  return {name.empty() ? 4 : 3, name};
}

}  // namespace

std::vector<double> Batch::rates(const std::string& category, const std::string& scheme,
                                 bool with_bursts) const {
  std::vector<double> out;
  for (const RunSummary& run : runs) {
    if (run.category != category) continue;
    const double rate = with_bursts ? run.rate(scheme) : run.rate_payload(scheme);
    if (!std::isnan(rate)) out.push_back(rate);
  }
  return out;
}

size_t Batch::color_of(const std::string& scheme, size_t otherwise) const {
  const auto found = std::find(schemes.begin(), schemes.end(), scheme);
  return found == schemes.end() ? otherwise : static_cast<size_t>(found - schemes.begin());
}

std::string Batch::group_of(const RunSummary& run) const {
  return categories.size() > 1 ? category_label(run.category) : "";
}

void arrange_batch(Batch& batch) {
  for (const RunSummary& run : batch.runs)
    for (const std::string& scheme : run.schemes)
      if (std::find(batch.schemes.begin(), batch.schemes.end(), scheme) == batch.schemes.end())
        batch.schemes.push_back(scheme);
  if (!batch.schemes.empty()) batch.baseline = batch.schemes.front();
  for (const std::string& scheme : batch.schemes)
    if (scheme == "dcp") batch.baseline = scheme;
  std::stable_sort(
      batch.schemes.begin(), batch.schemes.end(),
      [](const std::string& a, const std::string& b) { return scheme_group(a) < scheme_group(b); });

  std::stable_sort(batch.runs.begin(), batch.runs.end(), [&](const RunSummary& a, const RunSummary& b) {
    const auto key = [&](const RunSummary& run) {
      const double rate = run.rate_payload(batch.baseline);
      return std::tuple(category_order(run.category), std::isnan(rate) ? INFINITY : rate);
    };
    return key(a) < key(b);
  });
  for (const RunSummary& run : batch.runs)
    if (batch.categories.empty() || batch.categories.back() != run.category)
      batch.categories.push_back(run.category);

  for (RunSummary& run : batch.runs)
    for (SurfacePlots& surface : run.surfaces)
      for (LinePlot& plot : surface.plots)
        for (PlotLine& line : plot.lines) line.color_index = batch.color_of(line.name, line.color_index);
}

std::string category_label(const std::string& category) {
  return category.empty() ? "no category" : category;
}

std::string section_html(const Section& section) {
  const std::string& name = section.table.name;
  std::string out = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", name, escape_html(section.heading));
  if (!section.note.empty()) out += "<p class=\"note\">" + section.note + "</p>\n";
  if (!section.chart.empty()) out += "<div class=\"chart\">\n" + section.chart + "</div>\n";
  const std::string tools = "<div class=\"tools\">" + csv_button(name, name + ".csv") + "</div>\n";
  const auto folded = [&](const std::string& summary) {
    return "<details><summary>" + summary + "</summary>\n" + table_html(section.table) + "</details>\n";
  };
  if (!section.chart.empty())
    out += tools + folded("The same as a table");
  else
    out += (section.folded ? folded(counted(section.table.rows.size(), "row")) : table_html(section.table)) +
           tools;
  return out + "</section>\n";
}

std::string section_link(const std::string& id, const std::string& heading) {
  return fmt::format("<a href=\"#{}\">{}</a>\n", escape_html(id), escape_html(heading));
}

}  // namespace tilepress
