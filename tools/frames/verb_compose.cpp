// tilepress compose: the read bandwidth of showing several packed surfaces at once.
#include <algorithm>
#include <memory>
#include <tuple>

#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "frames/composed_trace.h"
#include "frames/composition.h"
#include "frames/frame_size.h"
#include "frames/packed_reader.h"
#include "progress_line.h"
#include "streams/output_file.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress compose desktop.tpk bar.tpk --at 0,0 --at 0,1240 -o reads.csv\n"
    "  tilepress compose --skip-hidden --refresh 120 back.tpk window.tpk -o - | head\n"
    "  tilepress compose desktop.tpk bar.tpk --memory-trace reads.dramsim3\n"
    "\n"
    "Name the surfaces from the bottom up. A file with fewer frames goes on showing its last one.\n";

struct ComposeOptions {
  std::vector<std::string> files;
  std::vector<std::pair<int32_t, int32_t>> places;
  std::optional<FrameSize> screen;
  CompositionOptions composition;
  FrameSet frames;
  double refresh_hz = 60;
  std::string output;
  MemoryTraceOptions trace;
  bool force = false;
  bool quiet = false;
};

using PackedFiles = std::vector<std::unique_ptr<PackedFile>>;

/// Opens the files and places a layer for each.
Result<PackedFiles> open_files(const ComposeOptions& options, std::vector<Layer>& layers) {
  PackedFiles files;
  for (size_t i = 0; i < options.files.size(); ++i) {
    auto file = open_packed_file(options.files[i]);
    if (!file) return file.error();
    if ((*file)->reader.count() == 0)
      return Error{ErrorKind::kUnsupported, options.files[i] + ": holds no surface"};
    files.push_back(std::move(*file));
    Layer& layer = layers.emplace_back();
    if (i < options.places.size()) std::tie(layer.x, layer.y) = options.places[i];
  }
  return files;
}

uint64_t frame_count(const PackedFiles& files) {
  uint64_t count = 0;
  for (const auto& file : files) count = std::max<uint64_t>(count, file->reader.count());
  return count;
}

/// Reads the surfaces of a frame. A shorter file goes on showing its last surface. `first`: nothing is shown
/// yet.
Result<void> show_frame(uint64_t frame, bool first, const PackedFiles& files, std::vector<Layer>& layers) {
  for (size_t i = 0; i < layers.size(); ++i) {
    PackedFileReader& packed = files[i]->reader;
    const auto wanted = static_cast<uint32_t>(std::min<uint64_t>(frame, packed.count() - 1));
    if (!first && layers[i].number == wanted) continue;
    if (const auto read = packed.read(wanted, layers[i].surface); !read)
      return about(files[i]->path, read.error());
    layers[i].number = wanted;
  }
  return {};
}

/// The smallest screen with its corner at 0,0 that holds all surfaces.
FrameSize reach_of(const std::vector<Layer>& layers) {
  const auto end = [](int32_t at, uint32_t side) {
    return static_cast<uint32_t>(std::max<int64_t>(0, int64_t{at} + side));
  };
  FrameSize reach;
  for (const Layer& layer : layers) {
    reach.width = std::max(reach.width, end(layer.x, layer.surface.width));
    reach.height = std::max(reach.height, end(layer.y, layer.surface.height));
  }
  return reach;
}

/// Composes every wanted frame, writes its rows to `out` if that is open, and its reads to `trace` unless that is
/// null. Fills `composition.width` and
/// `height`. Returns the number of frames composed.
Result<uint64_t> compose_frames(ComposeOptions& options, const PackedFiles& files, std::vector<Layer>& layers,
                                OutputFile& out, ComposedTrace* trace, ComposedSummary& summary) {
  const uint64_t count = frame_count(files);
  uint64_t taken = 0;
  ProgressLine progress(options.quiet ? ProgressMode::kNever : ProgressMode::kAuto, "compose");
  for (uint64_t frame = 0; frame < count; ++frame) {
    if (!options.frames.contains(frame)) continue;
    if (const auto shown = show_frame(frame, taken == 0, files, layers); !shown) return shown.error();
    if (taken++ == 0) {
      const FrameSize screen = options.screen.value_or(reach_of(layers));
      options.composition.width = screen.width;
      options.composition.height = screen.height;
    }
    const auto reads = read_composition(layers, options.composition);
    if (!reads) return reads.error();
    if (trace != nullptr)
      if (const auto added = trace->add(frame, layers, *reads); !added) return added.error();
    for (size_t i = 0; i < layers.size() && out.is_open(); ++i)
      out.write(composed_csv_row(frame, i, files[i]->path, layers[i], (*reads)[i]));
    progress.show(frame + 1, count);
    // DCP stores frame 0 raw: the sums leave it out, unless there is no other frame.
    if (frame == 0 && count > 1 && options.frames.last() != 0u) continue;
    ++summary.frames;
    for (size_t i = 0; i < layers.size(); ++i)
      summary.totals[i] += totals_of((*reads)[i], layers[i].surface.burst_bits);
  }
  return taken;
}

int compose(ComposeOptions& options) {
  std::vector<Layer> layers;
  const auto files = open_files(options, layers);
  if (!files) return fail(kExitFailed, files.error());
  OutputFile out;
  if (!options.output.empty()) {
    if (const auto opened = out.open(options.output, options.force); !opened)
      return fail(kExitFailed, opened.error());
    out.write(composed_csv_header());
  }
  ComposedTrace trace;
  const bool traced = !options.trace.path.empty();
  if (traced)
    if (const auto opened = trace.open(options.trace, *files, options.refresh_hz); !opened)
      return fail_trace(opened.error());
  options.composition.note_fetches = traced;
  ComposedSummary summary;
  summary.files = options.files;
  summary.totals.resize(layers.size());
  summary.refresh_hz = options.refresh_hz;
  const auto taken = compose_frames(options, *files, layers, out, traced ? &trace : nullptr, summary);
  if (!taken) return fail(kExitFailed, taken.error());
  if (*taken == 0)
    return fail(kExitNothingCaptured,
                "--frames selects none of the frames 0.." + std::to_string(frame_count(*files) - 1));
  if (out.is_open())
    if (const auto done = out.commit(); !done) return fail(kExitFailed, done.error());
  if (traced) {
    const auto written = trace.finish();
    if (!written) return fail(kExitFailed, written.error());
    if (!options.quiet) show(*written);
  }
  summary.without_first = summary.frames < *taken;
  if (!options.quiet && summary.frames > 0) show(composed_table(summary, options.composition));
  return kExitDone;
}

}  // namespace

int verb_compose(int argc, char** argv) {
  CLI::App app("Computes the read bandwidth of showing several packed surfaces at once.");
  app.footer(kExamples);
  ComposeOptions options;
  app.add_option("FILE", options.files, "Files that tilepress pack wrote, at most 16")
      ->type_name("...")
      ->required();
  app.add_option_function<std::vector<std::string>>(
         "--at",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto place = parse_numbers<int32_t, 2>(text, ',');
             if (!place) throw CLI::ValidationError("--at " + text + ": not X,Y");
             options.places.emplace_back((*place)[0], (*place)[1]);
           }
         },
         "Place of a surface on the screen; one per file, in their order (default: 0,0)")
      ->type_name("X,Y")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  RunOptions run;
  add_run_option(app, run, "plugin", "Shared library with the scheme of a file; repeat for more");
  add_size_option(app, "screen", options.screen, "Size of the screen (default: it holds all surfaces)");
  app.add_flag("--skip-hidden", options.composition.skip_hidden,
               "Do not read blocks that surfaces without alpha hide");
  app.add_option("--refresh", options.refresh_hz, "Frames shown per second (default: 60)")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 1e6));
  add_frames_option(app, options.frames);
  add_read_options(app, options.composition.read);
  app.add_option("-o,--output", options.output,
                 "CSV file, a row per frame and surface; - for standard output")
      ->type_name("FILE");
  add_memory_trace_options(app, options.trace, kMemoryTraceHelp);
  app.add_flag("--force", options.force, "Replace the files if they exist");
  app.add_flag("-q,--quiet", options.quiet, "Print no table");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.files.size() > kMaxLayers)
    return fail(kExitUsage, counted(options.files.size(), "surface") + ": at most " +
                                std::to_string(kMaxLayers) + " are composed in one pass");
  if (options.places.size() > options.files.size())
    return fail(kExitUsage, "--at: given " + counted(options.places.size(), "time") + " for " +
                                counted(options.files.size(), "file"));
  for (const std::string& path : missing_paths(options.files)) return fail(kExitFailed, missing_text(path));
  options.trace.force = options.force;
  if (!options.trace.path.empty())
    if (const auto settled = settle_trace_options(options.trace); !settled) return fail_trace(settled.error());
  return compose(options);
}

}  // namespace tilepress
