// TOML text: toml++ with one setting for the whole program, and errors that name the line.
#pragma once

#include <string>

// toml++ has functions of one name for both settings. A program with both would call either.
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "tilepress/result.h"

namespace tilepress {

/// "line N: reason", kBadValue. Without a line: the reason alone.
inline Error at_line(const toml::source_region& source, const std::string& reason) {
  const auto line = source.begin.line;
  return {ErrorKind::kBadValue, (line > 0 ? "line " + std::to_string(line) + ": " : "") + reason};
}
inline Error at_line(const toml::node& node, const std::string& reason) {
  return at_line(node.source(), reason);
}

/// Parses what `parse` reads, such as `[&] { return toml::parse(text); }`. Error: see at_line.
template <class Parse>
Result<toml::table> parse_toml(const Parse& parse) {
  try {
    return parse();
  } catch (const toml::parse_error& error) {
    return at_line(error.source(), std::string(error.description()));
  }
}

}  // namespace tilepress
