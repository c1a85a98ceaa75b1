// Row lines: cells that are JSON numbers stay numbers, all others become strings.
#include "report/export/row_lines.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "tilepress/csv_reader.h"

namespace tilepress {
namespace {

bool read_text(const std::string& path, std::string& text, std::string& error) {
  std::ifstream file(path, std::ios::binary);
  text.assign(std::istreambuf_iterator<char>(file), {});
  if (file.is_open() && !file.bad()) return true;
  error = path + ": " + std::strerror(errno);
  return false;
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

bool write_rows(const std::string& file, const std::string& start, OutputFile& out, std::string& error) {
  std::string text;
  if (!read_text(file, text, error)) return false;
  CsvReader reader(text);
  std::vector<std::string> header, fields;
  if (!reader.next(header)) return true;
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
  return true;
}

}  // namespace

bool write_row_lines(const std::string& path, const std::string& name, OutputFile& out, std::string& error) {
  const std::string run = ",\"run\":" + json_text(name);
  std::string text, missing;
  // A run without run.json, or with one cut off by a crash, still has its rows.
  if (read_text(path + "/run.json", text, missing)) {
    const auto json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (json.is_object()) {
      nlohmann::ordered_json line = {{"type", "run"}, {"run", name}};
      for (const auto& [key, value] : json.items()) line[key] = value;
      out.write(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
  }
  return write_rows(path + "/frames.csv", "{\"type\":\"frame\"" + run, out, error) &&
         write_rows(path + "/schemes.csv", "{\"type\":\"scheme\"" + run, out, error);
}

}  // namespace tilepress
