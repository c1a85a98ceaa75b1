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
  app.add_option("RUN", options.runs, "Run directories, or folders of run directories")->required();
  app.add_option("--format", options.format, "gem5 (name value # description) or jsonl (one object per row)")
      ->type_name("gem5|jsonl")
      ->required()
      ->check([](const std::string& name) {
        return name == "gem5" || name == "jsonl" ? "" : "must be gem5 or jsonl, not '" + name + "'";
      });
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
