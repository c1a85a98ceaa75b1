// Study page: sections, line charts and assets in the report's template.
#include "study/figures/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "counted.h"
#include "report/report_page.h"
#include "study/figures/page_figures.h"

namespace tilepress {
namespace {

constexpr size_t kMaxTableRows = 400;  ///< of a figure on the page; its CSV file has all
constexpr size_t kOpenRows = 40;       ///< a longer table without a chart is folded

Table figure_table(const Figure& figure) {
  Table table{.name = figure.spec.name, .caption = figure.spec.title, .header = figure.table.header};
  for (const auto& texts : figure.table.rows) {
    auto& cells = table.rows.emplace_back();
    for (const std::string& text : texts) {
      const double number = number_or_nan(text);
      const bool fraction = std::isfinite(number) && number != std::floor(number);
      cells.push_back({fraction ? shown_number(number) : text, text});
    }
  }
  return table;
}

std::string file_links(const Figure& figure, bool drawn) {
  constexpr std::pair<const char*, const char*> kFiles[] = {{"csv", "CSV"}, {"svg", "SVG"}, {"pdf", "PDF"}};
  std::string out = "<p class=\"note\">This figure as";
  for (const auto& [ending, text] : kFiles)
    if (drawn || std::string_view(ending) == "csv")
      out += fmt::format(" <a href=\"figures/{}.{}\">{}</a>", escape_html(figure.spec.name), ending, text);
  return out + "</p>\n";
}

/// `series`: the line charts of the page for its script.
std::string figure_section(const StudyData& data, const Figure& figure, bool drawn,
                           std::vector<std::string>& series) {
  const PageChart chart = page_chart(data, figure);
  std::string out =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", figure.spec.name, escape_html(figure.spec.title));
  const std::string note = figure.spec.caption + (chart.remark.empty() ? "" : " " + chart.remark);
  out += "<p class=\"note\">" + escape_html(note) + "</p>\n";
  if (!chart.html.empty()) out += "<div class=\"chart\">\n" + chart.html + "</div>\n";
  if (!chart.lines.empty()) {
    out += fmt::format("<div class=\"line-charts\" data-series=\"{}\" data-picked=\"{}\"></div>\n",
                       series.size(), chart.picked);
    series.push_back("{\"surfaces\":" + surfaces_json(chart.lines) + "}");
  }
  out += file_links(figure, drawn);
  // Line charts have a table of their own.
  if (chart.lines.empty() && figure.table.rows.size() <= kMaxTableRows)
    out += "<details><summary>The rows of the CSV file</summary>\n" + table_html(figure_table(figure)) +
           "</details>\n";
  return out + "</section>\n";
}

Section table_section(const Table& table) {
  Section out{.heading = table.caption, .note = escape_html(table.note), .table = table};
  out.table.caption.clear();  // the heading says it
  out.folded = table.rows.size() > kOpenRows;
  return out;
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

std::string study_page(const StudyData& data, const std::vector<Claim>& claims,
                       const std::vector<Figure>& figures, const std::vector<Table>& tables,
                       const std::vector<std::string>& drawn) {
  std::vector<std::string> series;
  std::string nav, sections = missing_workloads(data);
  const Section claimed = claims_section(claims);
  nav += section_link(claimed.table.name, "Claims");
  sections += section_html(claimed);
  for (const Figure& figure : figures) {
    const bool has_drawing = std::find(drawn.begin(), drawn.end(), figure.spec.name) != drawn.end();
    nav += section_link(figure.spec.name, figure.spec.title);
    sections += figure_section(data, figure, has_drawing, series);
  }
  for (const Table& table : tables) {
    nav += section_link(table.name, table.caption);
    sections += section_html(table_section(table));
  }
  return page_html(
      {{"version", data.spec.version},
       {"title", escape_html(data.spec.title)},
       {"lead", escape_html(lead_text(data))},
       {"markers", marker_definitions()},
       {"nav", nav},
       {"sections", sections},
       {"series", fmt::format("[{}]", fmt::join(series, ",\n"))},
       {"footer",
        "Made from the CSV files and study.json in this folder; provenance.json names every input."}});
}

}  // namespace tilepress
