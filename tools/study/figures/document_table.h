// Document table: a table that goes into Markdown, LaTeX, HTML and CSV.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/html_text.h"

namespace tilepress {

/// What people see, and the exact text for CSV.
struct DocumentCell {
  std::string shown, exact;
};
DocumentCell document_text(std::string_view text);
DocumentCell document_count(uint64_t count);
/// Three decimals, as the report shows numbers. Empty for NaN.
DocumentCell document_number(double value);
/// As many digits as the number needs, for constants such as 0.00304232. Empty for NaN.
DocumentCell document_exact(double value);
/// A share of 0..1 in percent. Empty for NaN.
DocumentCell document_share(double share);

struct DocumentTable {
  std::string name{};     ///< of the files
  std::string caption{};  ///< a sentence
  std::vector<std::string> header{};
  size_t text_columns = 1;        ///< leading columns that are set flush left
  std::vector<size_t> wrapped{};  ///< columns of text that may take several lines
  std::vector<std::vector<DocumentCell>> rows{};
  std::string note{};  ///< below the table; may be empty

  std::string markdown() const;
  /// A tabular environment in a table. Needs the package booktabs.
  std::string latex() const;
  /// A page of its own.
  std::string html() const;
  std::string csv() const;
  /// For the report's pages.
  Table page_table() const;
  bool wraps(size_t column) const;
};

}  // namespace tilepress
