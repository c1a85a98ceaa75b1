// Document table: the four formats.
#include "study/figures/document_table.h"

#include <fmt/format.h>

#include <functional>

#include "study/figures/study_table.h"

namespace tilepress {
namespace {

constexpr std::string_view kPlainStyle =
    "body{font:16px/1.5 system-ui,sans-serif;margin:1rem auto;max-width:70rem;padding:0 1rem}"
    "table{border-collapse:collapse;font-size:.9rem}"
    "th,td{border-bottom:1px solid #ccd;padding:.2rem .6rem;text-align:right;vertical-align:top}"
    ".text{text-align:left}.scroll{overflow-x:auto}caption{text-align:left;padding:.3rem 0}";

std::string escape_markdown(std::string_view text) {
  return replaced(text, {{"|", "\\|"}, {"*", "\\*"}, {"_", "\\_"}, {"<", "&lt;"}, {"\n", " "}});
}

std::string escape_latex(std::string_view text) {
  return replaced(text, {{"&", "\\&"},
                         {"%", "\\%"},
                         {"$", "\\$"},
                         {"#", "\\#"},
                         {"_", "\\_"},
                         {"{", "\\{"},
                         {"}", "\\}"},
                         {"~", "\\textasciitilde{}"},
                         {"^", "\\textasciicircum{}"},
                         {"\\", "\\textbackslash{}"},
                         {"<", "$<$"},
                         {">", "$>$"},
                         {"×", "$\\times$"},
                         {"²", "$^2$"},
                         {"–", "--"},
                         {"−", "$-$"},
                         {"≥", "$\\geq$"},
                         {"Σ", "$\\Sigma$"}});
}

}  // namespace

std::string table_markdown(const Table& table) {
  std::string out = "**" + escape_markdown(table.caption) + "**\n\n|";
  for (const std::string& column : table.header) out.append(" ").append(escape_markdown(column)).append(" |");
  out += "\n|";
  for (size_t i = 0; i < table.header.size(); ++i)
    out += i < table.text_columns || table.wraps(i) ? " --- |" : " ---: |";
  for (const auto& row : table.rows) {
    out += "\n|";
    for (const Cell& cell : row) out.append(" ").append(escape_markdown(cell.shown)).append(" |");
  }
  out += "\n";
  if (!table.note.empty()) out.append("\n").append(escape_markdown(table.note)).append("\n");
  return out;
}

std::string table_latex(const Table& table) {
  constexpr size_t kWideColumns = 8;
  // A table with many columns or with lines of text takes the width of the page.
  const bool wide = table.header.size() > kWideColumns || !table.wrapped.empty();
  const std::string environment = wide ? "table*" : "table";
  std::string columns;
  for (size_t i = 0; i < table.header.size(); ++i)
    columns += table.wraps(i) ? "p{.3\\textwidth}" : i < table.text_columns ? "l" : "r";
  std::string out = fmt::format(
      "\\begin{{{}}}\n  \\centering\\small\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n  "
      "\\begin{{tabular}}{{{}}}\n    "
      "\\toprule\n",
      environment, escape_latex(table.caption), table.name, columns);
  const auto append_line = [&out](const auto& cells, auto text_of) {
    for (size_t i = 0; i < cells.size(); ++i)
      out += (i > 0 ? " & " : "    ") + escape_latex(std::invoke(text_of, cells[i]));
    out += " \\\\\n";
  };
  append_line(table.header, std::identity());
  out += "    \\midrule\n";
  for (const auto& row : table.rows) append_line(row, &Cell::shown);
  out += "    \\bottomrule\n  \\end{tabular}\n";
  if (!table.note.empty()) out += "  \\par\\smallskip\\footnotesize " + escape_latex(table.note) + "\n";
  return out + "\\end{" + environment + "}\n";
}

std::string table_page(const Table& table) {
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><style>{1}</style></head><body>\n",
      escape_html(table.caption), kPlainStyle);
  out += table_html(table);
  if (!table.note.empty()) out += "<p>" + escape_html(table.note) + "</p>\n";
  return out + "</body></html>\n";
}

std::string table_csv(const Table& table) {
  std::string out;
  append_record(table.header, std::identity(), out);
  for (const auto& row : table.rows) append_record(row, &Cell::exact, out);
  return out;
}

}  // namespace tilepress
