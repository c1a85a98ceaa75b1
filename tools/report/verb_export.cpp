// tilepress export: runs in the formats of other tools.
#include <string>
#include <vector>

#include "command_line.h"
#include "report/export/gem5_stats.h"
#include "report/export/row_lines.h"
#include "report/run_batch.h"
#include "streams/output_file.h"
#include "verb.h"

namespace tilepress {
namespace {

struct ExportOptions {
  std::vector<std::string> runs;
  std::string format, output = "-";
  bool per_frame = false;
};

bool export_run(const BatchEntry& entry, const ExportOptions& options, OutputFile& out, std::string& error) {
  if (options.format == "jsonl") return write_row_lines(entry.path, entry.name, out, error);
  const auto run = read_run(entry.path);
  if (!run) return error = run.error().text, false;
  out.write(gem5_stats(*run, gem5_name(entry.name), options.per_frame));
  return true;
}

}  // namespace

int verb_export(int argc, char** argv) {
  ExportOptions options;
  CLI::App app{"Writes runs as gem5's stats.txt or as JSON lines."};
  app.add_option("RUN", options.runs, "Run directories, or folders that hold some")->required();
  app.add_option("--format", options.format, "gem5 (name value # description) or jsonl (an object per row)")
      ->type_name("gem5|jsonl")
      ->required()
      ->check([](const std::string& name) {
        return name == "gem5" || name == "jsonl" ? "" : "must be gem5 or jsonl, not '" + name + "'";
      });
  app.add_option("-o,--output", options.output, "The file; - is standard output (default)")
      ->type_name("FILE");
  app.add_flag("--per-frame", options.per_frame, "gem5: one dump for each frame, not one for the run");
  if (const auto stop = parse_command_line(app, argc, argv)) return *stop;

  std::string error;
  const std::vector<BatchEntry> entries = find_runs(options.runs, error);
  if (entries.empty()) return fail(kExitFailed, error);
  OutputFile out;
  if (!out.open(options.output, true, error)) return fail(kExitFailed, error);
  for (const BatchEntry& entry : entries)
    if (!export_run(entry, options, out, error)) return fail(kExitFailed, error);
  return out.commit(error) ? kExitDone : fail(kExitFailed, error);
}

}  // namespace tilepress
