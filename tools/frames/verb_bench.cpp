// tilepress bench: the speed of each scheme beside memcpy and LZ4, on the same frames in the same run.
#include <fmt/format.h>

#include <filesystem>

#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "frames/bench_rounds.h"
#include "frames/image_folders.h"
#include "frames/image_frames.h"
#include "progress_line.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"
#include "tilepress/scheme.h"
#include "tilepress/simd.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "The images of one folder that follow each other are a set. Each round runs every operation once over\n"
    "all frames of a set, on one thread. The table shows medians over the rounds. Ratios compare times of\n"
    "the same round.\n"
    "\n"
    "Operations:\n"
    "  statistics   traversal, FVC, CCD and the sizes of all blocks\n"
    "  encode       the same, and the bits of all blocks written to memory\n"
    "  decode       all blocks restored from those bits\n"
    "Scheme 'all' is all schemes in one pass; 'metrics' is the frame metrics alone.\n"
    "\n"
    "Examples:\n"
    "  tilepress bench shots/*.png\n"
    "  tilepress bench -s vdcp -s ras --rounds 15 -o speed.csv ui/*.png game/*.png\n"
    "  tilepress bench --simd scalar shots/*.png\n";

struct BenchOptions {
  RunOptions run;
  std::string csv_path;  ///< empty = none
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  uint32_t rounds = 7;
};

/// Images of one folder that follow each other.
struct ImageSet {
  std::string name;
  std::vector<std::string> paths;
};

std::vector<ImageSet> split_sets(const std::vector<std::string>& paths) {
  std::vector<ImageSet> sets;
  for (const std::string& path : paths) {
    const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path().filename().string();
    if (sets.empty() || sets.back().name != folder) sets.push_back({folder, {}});
    sets.back().paths.push_back(path);
  }
  return sets;
}

Result<BenchFrames> load_set(const ImageSet& set, const BenchOptions& options) {
  ImageFrames images;
  if (const auto opened = images.open(set.paths, options.size); !opened) return opened.error();
  BenchFrames out{images.size().width, images.size().height, images.format(), {}};
  for (uint64_t i = 0;; ++i) {
    ImageFrame frame;
    const auto read = images.read(i, frame);
    if (!read) return read.error();
    if (!*read) return out;
    if (options.run.takes(i)) out.pixels.push_back(std::move(frame.pixels));
  }
}

std::string table_text(const std::string& set, const BenchFrames& frames, const std::vector<BenchRow>& rows) {
  std::string out =
      fmt::format("{}: {} of {}x{}, SIMD target {}\n", set, counted(frames.pixels.size(), "frame"),
                  frames.width, frames.height, simd_target());
  out += fmt::format("  {:<24} {:<11} {:>10} {:>12} {:>9} {:>8}\n", "scheme", "operation", "Mpixel/s",
                     "cycles/pixel", "/memcpy", "/LZ4");
  for (const BenchRow& row : rows)
    out += fmt::format("  {:<24} {:<11} {:>10.1f} {:>12.2f} {:>9.4f} {:>8.3f}\n", row.scheme, row.operation,
                       row.mpixels_per_s, row.cycles_per_pixel, row.ratio_to_memcpy, row.ratio_to_lz4);
  return out;
}

struct Row {
  const std::string& set;
  const BenchRow& figures;
};
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("set", row.set),
    TILEPRESS_CSV_FIGURE("scheme", row.figures.scheme),
    TILEPRESS_CSV_FIGURE("operation", row.figures.operation),
    TILEPRESS_CSV_FIGURE("mpixels_per_s", row.figures.mpixels_per_s),
    TILEPRESS_CSV_FIGURE("ratio_to_memcpy", row.figures.ratio_to_memcpy),
    TILEPRESS_CSV_FIGURE("ratio_to_lz4", row.figures.ratio_to_lz4),
    TILEPRESS_CSV_FIGURE("cycles_per_pixel", row.figures.cycles_per_pixel),
};

std::optional<int> parse(int argc, char** argv, BenchOptions& options) {
  CLI::App app("Measures the speed of each scheme, memcpy and LZ4. Prints a table on standard error.");
  app.footer(kExamples);
  add_model_options(app, options.run);
  app.add_option("-o,--output", options.csv_path,
                 "CSV file for the table; - for standard output (default: none)")
      ->type_name("FILE");
  app.add_option("IMAGE", options.images, "Images or movies of 8 bits a channel, or raw .rgba files")
      ->type_name("...")
      ->required();
  add_size_option(app, "size", options.size, "Size of raw .rgba frames");
  app.add_option("--rounds", options.rounds, "Number of rounds (default: 7)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option_function<std::string>(
         "--simd",
         [](const std::string& name) {
           const std::vector<std::string_view> known = simd_targets();
           if (!force_simd_target(name))
             throw CLI::ValidationError("--simd " + name + ": not one of " + listed_words(known, ", ") +
                                        nearest_hint(name, known));
         },
         "Instruction set (default: the best this machine has)")
      ->type_name("TARGET");
  return parse_command_line(app, argc, argv);
}

}  // namespace

int verb_bench(int argc, char** argv) {
  BenchOptions options;
  if (const auto status = parse(argc, argv, options)) return *status;
  OutputFile file;  // opened before the work, so that a bad path fails at once
  if (!options.csv_path.empty())
    if (const auto opened = file.open(options.csv_path, true); !opened)
      return fail(kExitFailed, opened.error());
  std::string csv = csv_header(kColumns);
  const auto paths = expand_image_folders(
      options.images, [&](const std::string& path) { return options.size && path.ends_with(".rgba"); });
  if (!paths) return fail(kExitFailed, paths.error());
  for (const std::string& path : missing_paths(*paths)) return fail(kExitFailed, missing_text(path));
  for (const ImageSet& set : split_sets(*paths)) {
    const auto frames = load_set(set, options);
    if (!frames) return fail(kExitFailed, frames.error());
    if (frames->pixels.empty())
      return fail(kExitNothingCaptured, set.name + ": --frames and --every leave no frame");
    if (const auto lines = unsupported_schemes(options.run.schemes, frames->format); !lines.empty())
      return fail(kExitFailed, set.name + ": " + lines.front());
    ProgressLine progress(ProgressMode::kAuto, "bench", "rounds");
    const std::vector<BenchRow> rows =
        bench_set(*frames, options.run.schemes, options.run.model, options.rounds,
                  [&](uint32_t done) { progress.show(done, options.rounds); });
    show(table_text(set.name, *frames, rows));
    for (const BenchRow& row : rows) append_csv_row(kColumns, Row{set.name, row}, csv);
  }
  if (!file.is_open()) return kExitDone;
  file.write(csv);
  const auto done = file.commit();
  return done ? kExitDone : fail(kExitFailed, done.error());
}

}  // namespace tilepress
