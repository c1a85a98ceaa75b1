// Document table: the four formats.
#include "study/figures/document_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/html_text.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

constexpr std::string_view kPlainStyle =
    "body{font:16px/1.5 system-ui,sans-serif;margin:1rem auto;max-width:70rem;padding:0 1rem}"
    "table{border-collapse:collapse;font-size:.9rem}"
    "th,td{border-bottom:1px solid #ccd;padding:.2rem .6rem;text-align:right;vertical-align:top}"
    ".text{text-align:left}.scroll{overflow-x:auto}caption{text-align:left;padding:.3rem 0}";

/// `text` with each character of `special` replaced.
std::string escape(std::string_view text, const std::map<char, std::string_view>& special) {
  std::string out;
  for (const char c : text) {
    const auto found = special.find(c);
    if (found == special.end())
      out += c;
    else
      out += found->second;
  }
  return out;
}

std::string escape_markdown(std::string_view text) {
  return escape(text, {{'|', "\\|"}, {'*', "\\*"}, {'_', "\\_"}, {'<', "&lt;"}, {'\n', " "}});
}

/// Replaces a sequence of bytes, for the few signs that LaTeX writes otherwise.
void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string escape_latex(std::string_view text) {
  std::string out = escape(text, {{'&', "\\&"},
                                  {'%', "\\%"},
                                  {'$', "\\$"},
                                  {'#', "\\#"},
                                  {'_', "\\_"},
                                  {'{', "\\{"},
                                  {'}', "\\}"},
                                  {'~', "\\textasciitilde{}"},
                                  {'^', "\\textasciicircum{}"},
                                  {'\\', "\\textbackslash{}"},
                                  {'<', "$<$"},
                                  {'>', "$>$"}});
  constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"×", "$\\times$"}, {"²", "$^2$"}, {"–", "--"}, {"−", "$-$"}, {"≥", "$\\geq$"}, {"Σ", "$\\Sigma$"}};
  for (const auto& [sign, command] : kSigns) replace_all(out, sign, command);
  return out;
}

}  // namespace

DocumentCell document_text(std::string_view text) {
  return {std::string(text), std::string(text)};
}
DocumentCell document_count(uint64_t count) {
  return document_text(std::to_string(count));
}
DocumentCell document_number(double value) {
  return {shown_number(value), std::isfinite(value) ? csv_number(value) : ""};
}
DocumentCell document_exact(double value) {
  return document_text(std::isfinite(value) ? csv_number(value) : "");
}
DocumentCell document_share(double share) {
  return {shown_percent(share), std::isfinite(share) ? csv_number(share) : ""};
}

bool DocumentTable::wraps(size_t column) const {
  return std::find(wrapped.begin(), wrapped.end(), column) != wrapped.end();
}

std::string DocumentTable::markdown() const {
  std::string out = "**" + escape_markdown(caption) + "**\n\n|";
  for (const std::string& column : header) out.append(" ").append(escape_markdown(column)).append(" |");
  out += "\n|";
  for (size_t i = 0; i < header.size(); ++i) out += i < text_columns || wraps(i) ? " --- |" : " ---: |";
  for (const auto& row : rows) {
    out += "\n|";
    for (const DocumentCell& cell : row) out.append(" ").append(escape_markdown(cell.shown)).append(" |");
  }
  out += "\n";
  if (!note.empty()) out.append("\n").append(escape_markdown(note)).append("\n");
  return out;
}

std::string DocumentTable::latex() const {
  constexpr size_t kWideColumns = 8;
  // A table with many columns or with lines of text takes the width of the page.
  const bool wide = header.size() > kWideColumns || !wrapped.empty();
  const std::string environment = wide ? "table*" : "table";
  std::string columns;
  for (size_t i = 0; i < header.size(); ++i) {
    columns += wraps(i) ? "p{.3\\textwidth}" : i < text_columns ? "l" : "r";
  }
  std::string out = fmt::format(
      "\\begin{{{}}}\n  \\centering\\small\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n  "
      "\\begin{{tabular}}{{{}}}\n    "
      "\\toprule\n",
      environment, escape_latex(caption), name, columns);
  const auto line = [&](size_t count, const auto& text_of) {
    out += "    ";
    for (size_t i = 0; i < count; ++i) out += (i > 0 ? " & " : "") + escape_latex(text_of(i));
    out += " \\\\\n";
  };
  line(header.size(), [&](size_t i) { return header[i]; });
  out += "    \\midrule\n";
  for (const auto& row : rows) line(row.size(), [&](size_t i) { return row[i].shown; });
  out += "    \\bottomrule\n  \\end{tabular}\n";
  if (!note.empty()) out += "  \\par\\smallskip\\footnotesize " + escape_latex(note) + "\n";
  return out + "\\end{" + environment + "}\n";
}

std::string DocumentTable::html() const {
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><style>{1}</style></head><body>\n",
      escape_html(caption), kPlainStyle);
  out += table_html(page_table());
  if (!note.empty()) out += "<p>" + escape_html(note) + "</p>\n";
  return out + "</body></html>\n";
}

std::string DocumentTable::csv() const {
  std::string out;
  const auto line = [&](size_t count, const auto& text_of) {
    for (size_t i = 0; i < count; ++i) {
      if (i > 0) out += ',';
      append_csv(out, text_of(i));
    }
    out += '\n';
  };
  line(header.size(), [&](size_t i) { return header[i]; });
  for (const auto& row : rows) line(row.size(), [&](size_t i) { return row[i].exact; });
  return out;
}

Table DocumentTable::page_table() const {
  Table table;
  table.id = "table-" + name;
  table.caption = caption;
  table.header = header;
  table.text_columns = text_columns;
  for (const auto& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (const DocumentCell& cell : row) {
      const std::string text = escape_html(cell.shown);
      cells.push_back(
          {wraps(cells.size()) && !text.empty() ? "<span class=\"wrap\">" + text + "</span>" : text,
           cell.exact});
    }
  }
  return table;
}

}  // namespace tilepress
