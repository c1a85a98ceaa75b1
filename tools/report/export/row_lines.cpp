// Row lines: cells that are JSON numbers stay numbers, all others become strings.
#include "report/export/row_lines.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "tilepress/csv_rows.h"

namespace tilepress {
namespace {

Result<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad()) return Error{ErrorKind::kFile, path + ": " + std::strerror(errno)};
  return text;
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// True if `text` is a number as JSON writes them: no leading zero, no leading plus, no "nan".
bool is_json_number(const std::string& text) {
  size_t i = !text.empty() && text[0] == '-' ? 1 : 0;
  const auto digits = [&] {
    const size_t begin = i;
    while (i < text.size() && text[i] >= '0' && text[i] <= '9') ++i;
    return i - begin;
  };
  const size_t first = i;
  const size_t whole = digits();
  if (whole == 0 || (whole > 1 && text[first] == '0')) return false;
  if (i < text.size() && text[i] == '.' && (++i, digits() == 0)) return false;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
    if (digits() == 0) return false;
  }
  return i == text.size();
}

Result<void> write_rows(const std::string& file, const std::string& start, OutputFile& out) {
  const auto text = read_text(file);
  if (!text) return text.error();
  CsvReader reader(*text);
  std::vector<std::string> header, fields;
  if (!reader.next(header)) return {};
  for (std::string& name : header) name = ',' + json_text(name) + ':';
  while (reader.next(fields)) {
    std::string line = start;
    for (size_t i = 0; i < fields.size() && i < header.size(); ++i) {
      line += header[i];
      line += is_json_number(fields[i]) ? fields[i]
              : fields[i].empty()       ? std::string("null")
                                        : json_text(fields[i]);
    }
    line += "}\n";
    out.write(line);
  }
  return {};
}

}  // namespace

Result<void> write_row_lines(const std::string& path, const std::string& name, OutputFile& out) {
  const std::string run = ",\"run\":" + json_text(name);
  // A run whose run.json is missing or was cut off by a crash still has its rows.
  if (const auto text = read_text(path + "/run.json")) {
    const auto json = nlohmann::ordered_json::parse(*text, nullptr, false);
    if (json.is_object()) {
      nlohmann::ordered_json line = {{"type", "run"}, {"run", name}};
      for (const auto& [key, value] : json.items()) line[key] = value;
      out.write(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
  }
  const auto frames = write_rows(path + "/frames.csv", "{\"type\":\"frame\"" + run, out);
  return frames ? write_rows(path + "/schemes.csv", "{\"type\":\"scheme\"" + run, out) : frames;
}

}  // namespace tilepress
