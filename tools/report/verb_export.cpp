// tilepress export: runs in the formats of other tools.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command_line.h"
#include "report/export/gem5_stats.h"
#include "report/run_batch.h"
#include "streams/output_file.h"
#include "tilepress/csv_rows.h"
#include "tilepress/whole_file.h"
#include "verb.h"

namespace tilepress {
namespace {

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// True if `text` is a number as JSON writes them: no leading zero, no leading plus, no "nan".
bool is_json_number(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789";
  return !text.empty() && (text[0] == '-' || kDigits.find(text[0]) != kDigits.npos) &&
         kDigits.find(text.back()) != kDigits.npos && nlohmann::json::accept(text);
}

Result<void> write_rows(const std::string& file, const std::string& start, OutputFile& out) {
  const auto text = read_whole_file(file);
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

/// Writes to `out`: run.json as {"type":"run",…}, each row of frames.csv as {"type":"frame",…} and each row
/// of schemes.csv as {"type":"scheme",…}. Each column stands under its name, numbers with their digits in the
/// file. All objects have "run": `name`.
Result<void> write_row_lines(const std::string& path, const std::string& name, OutputFile& out) {
  const std::string run = ",\"run\":" + json_text(name);
  // A run whose run.json is missing or was cut off by a crash still has its rows.
  if (const auto text = read_whole_file(path + "/run.json")) {
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

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress export --format gem5 out -o stats.txt\n"
    "  tilepress export --format gem5 --per-frame out/glxgears-4711 -o stats.txt\n"
    "  tilepress export --format jsonl out | grep vdcp\n";

struct ExportOptions {
  std::vector<std::string> runs;
  std::string format, output = "-";
  bool per_frame = false;
};

Result<void> export_run(const BatchEntry& entry, const ExportOptions& options, OutputFile& out) {
  if (options.format == "jsonl") return write_row_lines(entry.path, entry.name, out);
  const auto run = read_run(entry.path);
  if (!run) return run.error();
  out.write(gem5_stats(*run, gem5_name(entry.name), options.per_frame));
  return {};
}

}  // namespace

int verb_export(int argc, char** argv) {
  ExportOptions options;
  CLI::App app{"Writes runs as gem5's stats.txt or as JSON lines."};
  app.footer(kExamples);
  app.add_option("RUN", options.runs, "Run directories, or folders of run directories")->required();
  app.add_option("--format", options.format, "gem5 (name value # description) or jsonl (one object per row)")
      ->type_name("gem5|jsonl")
      ->required()
      ->check(CLI::IsMember({"gem5", "jsonl"}));
  app.add_option("-o,--output", options.output, "File to write; - for standard output (default: -)")
      ->type_name("FILE");
  app.add_flag("--per-frame", options.per_frame, "gem5: one dump per frame, not one per run");
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  const auto entries = find_runs(options.runs);
  if (!entries) return fail(kExitFailed, entries.error());
  OutputFile out;
  auto done = out.open(options.output, true);
  for (size_t i = 0; done && i < entries->size(); ++i) done = export_run((*entries)[i], options, out);
  if (done) done = out.commit();
  return done ? kExitDone : fail(kExitFailed, done.error());
}

}  // namespace tilepress
