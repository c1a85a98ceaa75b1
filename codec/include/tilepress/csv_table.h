// CSV table: the columns of a CSV file (RFC 4180, '\n' line ends). Header, writer and reader follow from
// them.
#pragma once

#include <charconv>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace tilepress {

/// Quotes a field if RFC 4180 requires it.
std::string csv_field(std::string_view text);
/// Returns the shortest decimal that reads back as the same double. The decimal point is '.' in every locale.
std::string csv_number(double value);

/// Appends a value as a field: numbers as csv_number() prints them, booleans as 1 and 0.
template <class T>
void append_csv(std::string& out, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    out += value ? '1' : '0';
  } else if constexpr (std::is_arithmetic_v<T>) {
    char buffer[32];
    out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  } else {
    const std::string_view text = value;
    if (text.find_first_of(",\"\r\n") == std::string_view::npos)
      out += text;
    else
      out += csv_field(text);
  }
}

/// Reads a field, without its quotes, back into a value. Returns false for a number that is none.
template <class T>
bool read_csv(std::string_view field, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    value = field == "1" || field == "true";
  } else if constexpr (std::is_arithmetic_v<T>) {
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
    return code == std::errc() && end == field.data() + field.size();
  } else {
    value = field;
  }
  return true;
}

template <class Row>
struct CsvColumn {
  std::string_view name;
  void (*print)(const Row& row, std::string& out);
  /// Null for a figure that follows from other columns: a reader skips it.
  bool (*read)(std::string_view field, Row& row) = nullptr;
  /// A file may lack the column, or have empty fields there: the row keeps its value.
  bool optional = false;
};

/// A column that holds a member: a pointer to a member, or a function from a row to a reference.
template <class Row, auto member>
constexpr CsvColumn<Row> csv_column(std::string_view name, bool optional = false) {
  return {name, [](const Row& row, std::string& out) { append_csv(out, std::invoke(member, row)); },
          [](std::string_view field, Row& row) { return read_csv(field, std::invoke(member, row)); },
          optional};
}

/// A column that is computed from the row.
template <class Row, auto figure>
constexpr CsvColumn<Row> csv_figure(std::string_view name) {
  return {name, [](const Row& row, std::string& out) { append_csv(out, std::invoke(figure, row)); }};
}

/// A figure as an expression of `row`, in tables whose row type has the local name Row.
#define TILEPRESS_CSV_FIGURE(name, expression) \
  ::tilepress::csv_figure<Row, [](const Row& row) { return expression; }>(name)

/// Appends the names, with commas and without a line end.
template <class Columns>
void append_csv_names(const Columns& columns, std::string& out) {
  for (bool first = true; const auto& column : columns) {
    if (!first) out += ',';
    first = false;
    out += column.name;
  }
}

/// Appends the row's fields, with commas and without a line end.
template <class Columns, class Row>
void append_csv_fields(const Columns& columns, const Row& row, std::string& out) {
  for (bool first = true; const auto& column : columns) {
    if (!first) out += ',';
    first = false;
    column.print(row, out);
  }
}

template <class Columns>
std::string csv_header(const Columns& columns) {
  std::string out;
  append_csv_names(columns, out);
  return out += '\n';
}

template <class Columns, class Row>
void append_csv_row(const Columns& columns, const Row& row, std::string& out) {
  append_csv_fields(columns, row, out);
  out += '\n';
}

}  // namespace tilepress
