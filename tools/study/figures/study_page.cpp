// Study page: sections, line charts and assets in the report's template.
#include "study/figures/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "counted.h"
#include "report/page_assets.h"
#include "study/figures/page_figures.h"

namespace tilepress {
namespace {

constexpr size_t kMaxTableRows = 400;  ///< of a figure on the page; its CSV file has all
constexpr size_t kOpenRows = 40;       ///< a longer table without a chart is folded

/// Chooses the drawing by the figure's kind and shape.
struct ChartRule {
  const char* kind;
  PageChart (*make)(const StudyData& data, const Figure& figure);
};
constexpr ChartRule kCharts[] = {{"metrics over time", change_lines},
                                 {"colour CDF", cdf_lines},
                                 {"coverage against rate", coverage_scatter},
                                 {"rates of workloads", rate_dots},
                                 {"means", mean_bars},
                                 {"rate over bursts", burst_dots},
                                 {"hybrid shares", share_stacks}};

bool mostly_words(const Figure& figure) {
  size_t words = 0;
  for (const std::string& text : figure.x_order) {
    const bool digits = !text.empty() && text.find_first_not_of("0123456789.") == std::string::npos;
    words += digits ? 0 : 1;
  }
  return 2 * words > figure.x_order.size();
}

Table figure_table(const Figure& figure) {
  Table table;
  table.id = "table-" + figure.spec.name;
  table.caption = figure.spec.title;
  table.header = figure.table.header;
  for (size_t row = 0; row < figure.table.rows.size(); ++row) {
    auto& cells = table.rows.emplace_back();
    for (const std::string& column : table.header) {
      const double number = figure.table.number(row, column);
      const std::string& text = figure.table.text(row, column);
      const bool fraction = std::isfinite(number) && number != std::floor(number);
      cells.push_back({fraction ? shown_number(number) : escape_html(text), text});
    }
  }
  return table;
}

/// Collects the line charts of the page for its script.
class LineSeries {
 public:
  /// Returns the place where the script puts the charts.
  std::string add(const PageLines& lines) {
    std::string& out = json_.emplace_back("{\"surfaces\":[");
    for (size_t i = 0; i < lines.plots.size(); ++i)
      out += fmt::format("{}{{\"label\":\"{}\",\"plots\":[{}]}}", i > 0 ? "," : "",
                         escape_json(lines.plots[i].first), line_plot_json(lines.plots[i].second));
    out += "]}";
    return fmt::format("<div class=\"line-charts\" data-series=\"{}\" data-picked=\"{}\"></div>\n",
                       json_.size() - 1, lines.picked);
  }
  std::string json() const { return fmt::format("[{}]", fmt::join(json_, ",\n")); }

 private:
  std::vector<std::string> json_;
};

std::string file_links(const Figure& figure, bool drawn) {
  constexpr std::pair<const char*, const char*> kFiles[] = {{"csv", "CSV"}, {"svg", "SVG"}, {"pdf", "PDF"}};
  std::string out = "<p class=\"note\">This figure as";
  for (const auto& [ending, text] : kFiles)
    if (drawn || std::string_view(ending) == "csv")
      out += fmt::format(" <a href=\"figures/{}.{}\">{}</a>", escape_html(figure.spec.name), ending, text);
  return out + "</p>\n";
}

std::string figure_section(const StudyData& data, const Figure& figure, bool drawn, LineSeries& series) {
  const PageChart chart = page_chart(data, figure);
  std::string out =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", figure.spec.name, escape_html(figure.spec.title));
  const std::string note = figure.spec.caption + (chart.remark.empty() ? "" : " " + chart.remark);
  out += "<p class=\"note\">" + escape_html(note) + "</p>\n";
  if (!chart.html.empty()) out += "<div class=\"chart\">\n" + chart.html + "</div>\n";
  if (!chart.lines.plots.empty()) out += series.add(chart.lines);
  out += file_links(figure, drawn);
  // Line charts have a table of their own.
  if (chart.lines.plots.empty() && figure.table.rows.size() <= kMaxTableRows)
    out += "<details><summary>The rows of the CSV file</summary>\n" + table_html(figure_table(figure)) +
           "</details>\n";
  return out + "</section>\n";
}

std::string table_section(const DocumentTable& table) {
  std::string out = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", table.name, escape_html(table.caption));
  if (!table.note.empty()) out += "<p class=\"note\">" + escape_html(table.note) + "</p>\n";
  Table shown = table.page_table();
  shown.caption.clear();  // the heading says it
  const std::string text = table_html(shown);
  out += table.rows.size() <= kOpenRows ? text
                                        : fmt::format("<details><summary>{}</summary>\n{}</details>\n",
                                                      counted(table.rows.size(), "row"), text);
  return out + "<div class=\"tools\">" + csv_button("table-" + table.name, table.name + ".csv") +
         "</div>\n</section>\n";
}

/// A line that names the workloads without results; empty if there are none.
std::string missing_workloads(const StudyData& data) {
  std::vector<std::string> names;
  for (size_t row = 0; row < data.workloads.row_count(); ++row) {
    const std::string& status = data.workloads.text(row, "status");
    if (status == "done") continue;
    const std::string& reason = data.workloads.text(row, "reason");
    names.push_back(data.workloads.text(row, "workload") + " (" + status +
                    (reason.empty() ? "" : ": " + reason) + ")");
  }
  if (names.empty()) return "";
  return "<p class=\"warn\">Not complete: " + escape_html(fmt::format("{}", fmt::join(names, "; "))) +
         "</p>\n";
}

std::string lead_text(const StudyData& data) {
  double frames = 0;
  for (const size_t row : data.ordered_workloads()) {
    const double own = data.workloads.number(row, "frames");
    frames += std::isfinite(own) ? own : 0;
  }
  return fmt::format("{}, {}, {}. Rate = raw bits / moved bits; higher is better.",
                     counted(data.ordered_workloads().size(), "workload"),
                     counted(static_cast<uint64_t>(frames), "frame"),
                     counted(data.configurations().size(), "configuration"));
}

}  // namespace

PageChart page_chart(const StudyData& data, const Figure& figure) {
  for (const ChartRule& rule : kCharts)
    if (figure.spec.kind == rule.kind) return rule.make(data, figure);
  if (figure.spec.by_workload) return workload_lines(data, figure);
  return mostly_words(figure) ? axis_bars(data, figure) : axis_lines(data, figure);
}

std::string study_page(const StudyData& data, const std::vector<Claim>& claims,
                       const std::vector<Figure>& figures, const std::vector<DocumentTable>& tables,
                       const std::vector<std::string>& drawn) {
  LineSeries series;
  std::string nav, sections = missing_workloads(data);
  const auto link = [&](const std::string& id, const std::string& heading) {
    nav += fmt::format("<a href=\"#{}\">{}</a>\n", escape_html(id), escape_html(heading));
  };
  const Section claimed = claims_section(claims);
  link(claimed.id, "Claims");
  sections += section_html(claimed);
  for (const Figure& figure : figures) {
    const bool has_drawing = std::find(drawn.begin(), drawn.end(), figure.spec.name) != drawn.end();
    link(figure.spec.name, figure.spec.title);
    sections += figure_section(data, figure, has_drawing, series);
  }
  for (const DocumentTable& table : tables) {
    link(table.name, table.caption);
    sections += table_section(table);
  }
  const std::string footer =
      "<p>Made from the CSV files and study.json in this folder; provenance.json names every input. The line "
      "charts use uPlot 1.6.32 (MIT licence, text in the page's source).</p>";
  return fill_slots(kPageTemplate, {{"version", data.spec.version},
                                    {"title", escape_html(data.spec.title)},
                                    {"lead", escape_html(lead_text(data))},
                                    {"uplot_style", std::string(kUplotStyle)},
                                    {"uplot_script", std::string(kUplotScript)},
                                    {"uplot_licence", std::string(kUplotLicence)},
                                    {"style", std::string(kPageStyle)},
                                    {"script", std::string(kPageScript)},
                                    {"markers", marker_definitions()},
                                    {"nav", nav},
                                    {"sections", sections},
                                    {"series", series.json()},
                                    {"footer", footer}});
}

}  // namespace tilepress
