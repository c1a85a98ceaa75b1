// Document table: a table as Markdown, LaTeX, HTML and CSV.
#pragma once

#include <string>

#include "report/html_text.h"

namespace tilepress {

std::string table_markdown(const Table& table);
/// A tabular environment in a table. Needs the package booktabs.
std::string table_latex(const Table& table);
/// A page of its own.
std::string table_page(const Table& table);
/// The exact texts.
std::string table_csv(const Table& table);

}  // namespace tilepress
