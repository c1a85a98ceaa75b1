// tilepress compose: the read bandwidth of showing several packed surfaces at once.
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "command_line.h"
#include "common_options.h"
#include "frames/composition.h"
#include "frames/image_frames.h"
#include "frames/packed_file.h"
#include "frames/read_options.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"
#include "tilepress/run_options.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress compose desktop.tpk bar.tpk --at 0,0 --at 0,1240 -o reads.csv\n"
    "  tilepress compose --skip-hidden --refresh 120 back.tpk window.tpk -o - | head\n"
    "\n"
    "Surfaces are given from the bottom up. A file with fewer frames goes on showing its last one.\n";

struct ComposeOptions {
  std::vector<std::string> files;
  std::vector<std::pair<int32_t, int32_t>> places;
  std::optional<FrameSize> screen;
  CompositionOptions composition;
  FrameSet frames;
  double refresh_hz = 60;
  std::string output;
  bool force = false;
  bool quiet = false;
};

struct Source {
  std::string path;
  std::ifstream file;
  PackedFileReader packed;
  std::optional<uint32_t> shown;  ///< number of the surface read last
};

/// Sums over frames of what one layer, or all, moved.
struct ReadTotals {
  uint64_t blocks = 0, hidden = 0;
  uint64_t payload_bits = 0, csb_bits = 0, table_bits = 0, raw_bits = 0;
  uint64_t moved_bits() const { return payload_bits + csb_bits + table_bits; }
  double rate() const {
    return moved_bits() == 0 ? 0.0 : static_cast<double>(raw_bits) / static_cast<double>(moved_bits());
  }
  void add(const LayerTraffic& layer, uint32_t burst_bits) {
    blocks += layer.traffic.blocks;
    hidden += layer.hidden_blocks;
    payload_bits += layer.traffic.payload_bursts * burst_bits;
    csb_bits += layer.traffic.csb_bursts * burst_bits;
    table_bits += layer.traffic.table_bursts * burst_bits;
    raw_bits += layer.traffic.raw_bursts * burst_bits;
  }
};

constexpr const char* kHeader =
    "frame,surface,file,scheme,x,y,width,height,blocks,hidden_blocks,outside_blocks,burst_bits,payload_"
    "bursts,"
    "csb_bursts,table_bursts,raw_bursts,moved_bits,raw_bits,rate\n";

std::string row(uint64_t frame, size_t index, const Source& source, const Layer& layer,
                const LayerTraffic& read) {
  ReadTotals sum;
  sum.add(read, layer.surface.burst_bits);
  std::string out = std::to_string(frame) + ',' + std::to_string(index) + ',' + csv_field(source.path) + ',' +
                    csv_field(layer.surface.scheme.text);
  for (const int64_t value :
       {int64_t{layer.x}, int64_t{layer.y}, int64_t{layer.surface.width}, int64_t{layer.surface.height}})
    out += ',' + std::to_string(value);
  for (const uint64_t value :
       {read.traffic.blocks, read.hidden_blocks, read.outside_blocks, uint64_t{layer.surface.burst_bits},
        read.traffic.payload_bursts, read.traffic.csb_bursts, read.traffic.table_bursts,
        read.traffic.raw_bursts, sum.moved_bits(), sum.raw_bits})
    out += ',' + std::to_string(value);
  return out + ',' + csv_number(sum.rate()) + '\n';
}

void print_table(const ComposeOptions& options, const std::vector<std::unique_ptr<Source>>& sources,
                 const std::vector<ReadTotals>& totals, uint64_t frames, bool without_first) {
  ReadTotals all;
  std::fprintf(stderr, "%zu surfaces on %ux%u at %g Hz, %llu frames%s\n", sources.size(),
               options.composition.width, options.composition.height, options.refresh_hz,
               static_cast<unsigned long long>(frames),
               without_first ? " (without the first, which has no dictionary yet)" : "");
  std::fprintf(stderr, "  %10s %10s %10s %10s %10s %8s  %s\n", "raw MB/s", "MB/s", "payload", "CSB", "tables",
               "rate", "surface");
  const auto line = [&](const ReadTotals& sum, const std::string& name) {
    const auto bandwidth = [&](uint64_t bits) {
      return static_cast<double>(bits) / 8 / static_cast<double>(frames) * options.refresh_hz / 1e6;
    };
    std::fprintf(stderr, "  %10.3f %10.3f %10.3f %10.3f %10.3f %8.3f  %s\n", bandwidth(sum.raw_bits),
                 bandwidth(sum.moved_bits()), bandwidth(sum.payload_bits), bandwidth(sum.csb_bits),
                 bandwidth(sum.table_bits), sum.rate(), name.c_str());
  };
  for (size_t i = 0; i < sources.size(); ++i) {
    line(totals[i], sources[i]->path);
    all.blocks += totals[i].blocks;
    all.hidden += totals[i].hidden;
    all.payload_bits += totals[i].payload_bits;
    all.csb_bits += totals[i].csb_bits;
    all.table_bits += totals[i].table_bits;
    all.raw_bits += totals[i].raw_bits;
  }
  line(all, "all");
  if (options.composition.skip_hidden)
    std::fprintf(stderr, "  %llu blocks read, %llu hidden ones left out\n",
                 static_cast<unsigned long long>(all.blocks), static_cast<unsigned long long>(all.hidden));
}

bool open_sources(const ComposeOptions& options, std::vector<std::unique_ptr<Source>>& sources,
                  std::vector<Layer>& layers, std::string& error) {
  layers.resize(options.files.size());
  for (size_t i = 0; i < options.files.size(); ++i) {
    auto source = std::make_unique<Source>();
    source->path = options.files[i];
    source->file.open(source->path, std::ios::binary);
    if (!source->file || std::filesystem::is_directory(source->path)) {
      error = source->path + ": " + (source->file ? "is a folder" : std::strerror(errno));
      return false;
    }
    if (!source->packed.open(source->file, error) || source->packed.count() == 0) {
      error = source->path + ": " + (error.empty() ? "holds no surface" : error);
      return false;
    }
    if (i < options.places.size()) {
      layers[i].x = options.places[i].first;
      layers[i].y = options.places[i].second;
    }
    sources.push_back(std::move(source));
  }
  return true;
}

int compose(ComposeOptions& options) {
  std::string error;
  std::vector<std::unique_ptr<Source>> sources;
  std::vector<Layer> layers;
  if (!open_sources(options, sources, layers, error)) return fail(kExitFailed, error);
  uint64_t count = 0;
  for (const auto& source : sources) count = std::max<uint64_t>(count, source->packed.count());

  OutputFile out;
  if (!options.output.empty()) {
    if (!out.open(options.output, options.force, error)) return fail(kExitFailed, error);
    out.write(kHeader);
  }

  std::vector<ReadTotals> totals(layers.size());
  std::vector<LayerTraffic> reads;
  uint64_t measured = 0, taken = 0;
  for (uint64_t frame = 0; frame < count; ++frame) {
    if (!options.frames.contains(frame)) continue;
    for (size_t i = 0; i < layers.size(); ++i) {
      // A shorter sequence goes on showing its last frame.
      const auto wanted = static_cast<uint32_t>(std::min<uint64_t>(frame, sources[i]->packed.count() - 1));
      if (sources[i]->shown == wanted) continue;
      if (!sources[i]->packed.read(wanted, layers[i].surface, error))
        return fail(kExitFailed, sources[i]->path + ": " + error);
      sources[i]->shown = wanted;
    }
    if (taken == 0) {
      const auto reach = [](int32_t at, uint32_t side) {
        return static_cast<uint32_t>(std::max<int64_t>(0, int64_t{at} + side));
      };
      if (options.screen) {
        options.composition.width = options.screen->width;
        options.composition.height = options.screen->height;
      } else {
        for (const Layer& layer : layers) {
          options.composition.width =
              std::max(options.composition.width, reach(layer.x, layer.surface.width));
          options.composition.height =
              std::max(options.composition.height, reach(layer.y, layer.surface.height));
        }
      }
    }
    ++taken;
    if (!read_composition(layers, options.composition, reads, error)) return fail(kExitFailed, error);
    for (size_t i = 0; i < layers.size() && out.is_open(); ++i)
      out.write(row(frame, i, *sources[i], layers[i], reads[i]));
    // Frame 0 stays out of the sums: DCP stores it raw. Where there is nothing else, it is shown.
    if (frame == 0 && count > 1 && options.frames.last() != 0u) continue;
    ++measured;
    for (size_t i = 0; i < layers.size(); ++i) totals[i].add(reads[i], layers[i].surface.burst_bits);
  }
  if (taken == 0)
    return fail(kExitNothingCaptured, "--frames selects none of the frames 0.." + std::to_string(count - 1));
  if (out.is_open() && !out.commit(error)) return fail(kExitFailed, error);
  if (!options.quiet && measured > 0) print_table(options, sources, totals, measured, measured < taken);
  return kExitDone;
}

std::optional<std::pair<int32_t, int32_t>> parse_place(const std::string& text) {
  std::pair<int32_t, int32_t> place;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, place.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ',') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, place.second);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  return place;
}

}  // namespace

int verb_compose(int argc, char** argv) {
  CLI::App app("Reads the frames of several packed surfaces in one pass and accounts the bandwidth.");
  app.footer(kExamples);
  ComposeOptions options;
  app.add_option("FILE", options.files, "Files that tilepress pack wrote, at most 16")
      ->type_name("...")
      ->required();
  app.add_option_function<std::vector<std::string>>(
         "--at",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto place = parse_place(text);
             if (!place) throw CLI::ValidationError("--at " + text + ": not X,Y");
             options.places.push_back(*place);
           }
         },
         "Where a surface lies on the screen, once per file in their order (default: 0,0)")
      ->type_name("X,Y")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_size_option(app, "screen", options.screen, "Size of the screen (default: what the surfaces reach)");
  app.add_flag("--skip-hidden", options.composition.skip_hidden,
               "Leave out blocks that surfaces without alpha hide");
  app.add_option("--refresh", options.refresh_hz, "Frames shown a second (default: 60)")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 1e6));
  add_frames_option(app, options.frames);
  add_read_options(app, options.composition.read);
  app.add_option("-o,--output", options.output,
                 "CSV file, a row per frame and surface; - for standard output")
      ->type_name("FILE");
  app.add_flag("--force", options.force, "Replace the CSV file");
  app.add_flag("-q,--quiet", options.quiet, "No table");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.files.size() > kMaxLayers)
    return fail(kExitUsage, std::to_string(options.files.size()) + " surfaces: at most " +
                                std::to_string(kMaxLayers) + " are composed in one pass");
  if (options.places.size() > options.files.size())
    return fail(kExitUsage, "--at: given " + std::to_string(options.places.size()) + " times for " +
                                std::to_string(options.files.size()) + " files");
  return compose(options);
}

}  // namespace tilepress
