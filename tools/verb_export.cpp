// tilepress export: runs in the formats of other tools.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "command_line.h"
#include "export/gem5_stats.h"
#include "export/row_lines.h"
#include "report/run_batch.h"
#include "verb.h"

namespace tilepress {
namespace {

struct ExportOptions {
  std::vector<std::string> runs;
  std::string format, output = "-";
  bool per_frame = false;
};

bool export_run(const BatchEntry& entry, const ExportOptions& options, FILE* out, std::string& error) {
  if (options.format == "jsonl") return write_row_lines(entry.path, entry.name, out, error);
  RunRecord run;
  if (!read_run(entry.path, run, error)) return false;
  const std::string text = gem5_stats(run, gem5_name(entry.name), options.per_frame);
  std::fwrite(text.data(), 1, text.size(), out);
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
  const bool to_stdout = options.output == "-";
  FILE* out = to_stdout ? stdout : std::fopen(options.output.c_str(), "wb");
  if (out == nullptr) return fail(kExitFailed, options.output + ": " + std::strerror(errno));
  bool good = true;
  for (const BatchEntry& entry : entries) good = good && export_run(entry, options, out, error);
  if (good && (std::fflush(out) != 0 || std::ferror(out) != 0)) {
    good = false;
    error = (to_stdout ? std::string("standard output") : options.output) + ": " + std::strerror(errno);
  }
  if (!to_stdout) std::fclose(out);
  return good ? kExitDone : fail(kExitFailed, error);
}

}  // namespace tilepress
