// tilepress bench: the speed of each scheme beside memcpy and LZ4, on the same frames in the same run.
#include <cstdio>
#include <filesystem>

#include "frames/bench_rounds.h"
#include "command_line.h"
#include "common_options.h"
#include "frames/image_frames.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"
#include "tilepress/simd.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "One thread. Each round times every operation once over all frames of a set, one after the other; what "
    "is\n"
    "shown is the median over the rounds, ratios being taken within a round. A set is a run of images of "
    "one\n"
    "folder. Operations: statistics (traversal, FVC, CCD, sizes of every block), encode (the same and the "
    "bits\n"
    "written to memory), decode (blocks restored from those bits). 'all' is all schemes in one pass, "
    "'metrics'\n"
    "the frame metrics alone.\n"
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
  std::string simd;
};

/// Images of one folder that follow each other, decoded.
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

bool load_set(const ImageSet& set, const BenchOptions& options, BenchFrames& out, std::string& error) {
  ImageFrames images;
  if (!images.open(set.paths, options.size, error)) return false;
  out.width = images.size().width;
  out.height = images.size().height;
  out.format = images.format();
  for (uint64_t i = 0;; ++i) {
    ImageFrame frame;
    const auto outcome = images.read(i, frame, error);
    if (outcome == ImageFrames::Outcome::kFailed) return false;
    if (outcome == ImageFrames::Outcome::kEnd) return true;
    if (options.run.takes(i)) out.pixels.push_back(std::move(frame.pixels));
  }
}

void print_table(const std::string& set, const BenchFrames& frames, const std::vector<BenchRow>& rows) {
  std::fprintf(stderr, "%s: %zu frames of %ux%u, SIMD target %s\n", set.c_str(), frames.pixels.size(),
               frames.width, frames.height, std::string(simd_target()).c_str());
  std::fprintf(stderr, "  %-24s %-11s %10s %12s %9s %8s\n", "scheme", "operation", "Mpixel/s", "cycles/pixel",
               "/memcpy", "/LZ4");
  for (const BenchRow& row : rows)
    std::fprintf(stderr, "  %-24s %-11s %10.1f %12.2f %9.4f %8.3f\n", row.scheme.c_str(),
                 row.operation.c_str(), row.mpixels_per_s, row.cycles_per_pixel, row.ratio_to_memcpy,
                 row.ratio_to_lz4);
}

void append_csv(const std::string& set, const std::vector<BenchRow>& rows, std::string& csv) {
  for (const BenchRow& row : rows)
    csv += csv_field(set) + ',' + csv_field(row.scheme) + ',' + row.operation + ',' +
           csv_number(row.mpixels_per_s) + ',' + csv_number(row.ratio_to_memcpy) + ',' +
           csv_number(row.ratio_to_lz4) + ',' + csv_number(row.cycles_per_pixel) + '\n';
}

std::optional<int> parse(int argc, char** argv, BenchOptions& options) {
  CLI::App app(
      "Times each scheme beside memcpy and LZ4. A table goes to standard error; -o FILE.csv keeps it.");
  app.footer(kExamples);
  add_model_options(app, options.run);
  app.add_option("-o,--output", options.csv_path, "CSV file; - for standard output (default: none)")
      ->type_name("FILE");
  app.add_option("IMAGE", options.images, "Images or movies of 8 bits a channel, or raw .rgba files")
      ->type_name("...")
      ->required();
  add_size_option(app, "size", options.size, "Size of raw .rgba frames");
  app.add_option("--rounds", options.rounds, "Rounds (default: 7)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option_function<std::string>(
         "--simd",
         [](const std::string& name) {
           std::string known;
           for (std::string_view target : simd_targets())
             known += (known.empty() ? "" : ", ") + std::string(target);
           if (!force_simd_target(name))
             throw CLI::ValidationError("--simd " + name + ": not one of " + known);
         },
         "Instruction set (default: the best this machine has)")
      ->type_name("TARGET");
  return parse_command_line(app, argc, argv);
}

}  // namespace

int verb_bench(int argc, char** argv) {
  BenchOptions options;
  if (const auto status = parse(argc, argv, options)) return *status;
  std::string error;
  OutputFile file;  // opened first: a path that cannot be written is told before the work
  if (!options.csv_path.empty() && !file.open(options.csv_path, true, error)) return fail(kExitFailed, error);
  std::string csv = "set,scheme,operation,mpixels_per_s,ratio_to_memcpy,ratio_to_lz4,cycles_per_pixel\n";
  for (const ImageSet& set : split_sets(options.images)) {
    BenchFrames frames;
    if (!load_set(set, options, frames, error)) return fail(kExitFailed, error);
    if (frames.pixels.empty())
      return fail(kExitNothingCaptured, set.name + ": no frame left by --frames and --every");
    const std::vector<BenchRow> rows =
        bench_set(frames, options.run.schemes, options.run.model, options.rounds);
    print_table(set.name, frames, rows);
    append_csv(set.name, rows, csv);
  }
  if (!file.is_open()) return kExitDone;
  file.write(csv);
  return file.commit(error) ? kExitDone : fail(kExitFailed, error);
}

}  // namespace tilepress
