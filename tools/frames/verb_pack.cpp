// tilepress pack: images to a file of compressed surfaces.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "frames/image_frames.h"
#include "frames/packed_writer.h"
#include "frames/verify_error.h"
#include "progress_line.h"
#include "streams/output_file.h"
#include "tilepress/run_options.h"
#include "tilepress/scheme.h"
#include "tilepress/surface_engine.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress pack shots/*.png -o shots.tpk\n"
    "  tilepress pack -s hdcp:fvc=128 --verify shots/*.png -o shots.tpk\n"
    "  tilepress pack --format rgb565 --size 480x272 panel-*.rgb565 -o panel.tpk\n"
    "\n"
    "The first frame of a sequence has no dictionary yet: the DCP schemes store it raw.\n";

struct PackOptions {
  RunOptions run;
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  PixelFormat raw_format = PixelFormat::kRgba8;
  std::string output;
  bool force = false;
  bool quiet = false;
};

struct PackTotals {
  SchemeStatistics all, measured;  ///< measured: without the first frame
};

Result<PackTotals> pack_frames(ImageFrames& images, const PackOptions& options, PackedFileWriter& writer) {
  SurfaceEngine engine(options.run.schemes, options.run.model);
  const auto last = options.run.frames.last();
  ImageFrame frame;
  FrameStatistics statistics;
  CompressedSurface surface;
  PackTotals totals;
  ProgressLine progress(options.quiet ? ProgressMode::kNever : ProgressMode::kAuto, "pack");
  for (uint64_t number = 0; !last || number <= *last; ++number) {
    const auto read = images.read(number, frame);
    if (!read) return read.error();
    if (!*read) break;
    if (!options.run.takes(number)) continue;
    engine.process(images.view(frame), statistics, std::span(&surface, 1));
    const SchemeStatistics& scheme = statistics.schemes.front();
    if (scheme.mismatched_blocks > 0)
      return verify_error(surface.scheme.text, number, scheme.mismatched_blocks);
    if (const auto appended = writer.append(surface); !appended)
      return about(options.output, appended.error());
    totals.all += scheme;
    if (!statistics.warmup) totals.measured += scheme;
    progress.show(number + 1, images.count());
  }
  if (writer.count() == 0) return totals;
  if (const auto finished = writer.finish(); !finished) return about(options.output, finished.error());
  return totals;
}

std::string summary_text(const PackOptions& options, const ImageFrames& images, const PackTotals& totals,
                         uint32_t frames) {
  std::error_code code;
  const uint64_t file_bytes = std::filesystem::file_size(options.output, code);
  const auto bytes = [](uint64_t bits) { return (bits + 7) / 8; };
  std::string out =
      fmt::format("{}: {} of {} {}, {}\n", options.output, counted(frames, "frame"), images.size().text(),
                  traits(images.format()).name, options.run.schemes.front().text);
  out += fmt::format("  raw      {:>12} bytes\n", bytes(totals.all.raw_bits));
  out += fmt::format("  payload  {:>12} bytes, CSB {}, tables {}; in bursts {}\n",
                     bytes(totals.all.payload_bits), bytes(totals.all.csb_bits),
                     bytes(totals.all.palette_bits), bytes(totals.all.moved_bits()));
  out += fmt::format("  file     {:>12} bytes\n", file_bytes);
  if (totals.measured.raw_bits > 0)
    out += fmt::format("  rate     {:>12.3f} without the first frame\n", totals.measured.rate());
  return out;
}

int pack(const PackOptions& options) {
  PendingFile pending;
  if (const auto begun = pending.begin(options.output, options.force); !begun)
    return fail(kExitFailed, begun.error());
  ImageFrames images;
  if (const auto opened = images.open(options.images, options.size, options.raw_format); !opened)
    return fail(kExitFailed, opened.error());
  if (const auto lines = unsupported_schemes(options.run.schemes, images.format()); !lines.empty())
    return fail(kExitFailed, lines.front());
  std::ofstream file(pending.path(), std::ios::binary | std::ios::trunc);
  if (!file) return fail(kExitFailed, options.output + ": " + std::strerror(errno));
  PackedFileWriter writer(file);
  const auto totals = pack_frames(images, options, writer);
  if (!totals) return fail(kExitFailed, totals.error());
  if (writer.count() == 0) return fail(kExitNothingCaptured, "no frame to pack");
  file.close();
  if (!file) return fail(kExitFailed, options.output + ": " + std::strerror(errno));
  if (const auto done = pending.commit(); !done) return fail(kExitFailed, done.error());
  if (!options.quiet) show(summary_text(options, images, *totals, writer.count()));
  return kExitDone;
}

}  // namespace

int verb_pack(int argc, char** argv) {
  CLI::App app("Compresses images with one scheme into a file that unpack and compose read.");
  app.footer(kExamples);
  PackOptions options;
  options.run.output = "-";
  options.run.schemes = {*parse_scheme("vdcp")};
  app.add_option("IMAGE", options.images, "Images or movies of 8 bits a channel, or raw files")
      ->type_name("...")
      ->required();
  app.add_option("-o,--output", options.output, "File to write")->type_name("FILE")->required();
  add_model_options(app, options.run, "One scheme as name:key=value,... (default: vdcp)");
  add_run_option(app, options.run, "verify",
                 "Decode every block and compare it with the original; exit 1 if one differs");
  add_size_option(app, "size", options.size, "Size of raw frames");
  add_raw_format_option(app, options.raw_format);
  app.add_flag("--force", options.force, "Replace the file if it exists");
  app.add_flag("-q,--quiet", options.quiet, "Print no summary");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.raw_format != PixelFormat::kRgba8 && !options.size)
    return fail(kExitUsage, "--format: raw frames need --size WxH");
  if (options.run.schemes.size() != 1) return fail(kExitUsage, "--scheme: a packed file holds one scheme");
  const std::string& name = options.run.schemes.front().name;
  if (find_scheme(name)->needs_frame_before)
    return fail(kExitUsage, "--scheme " + name + ": its frames cannot be restored without the frame before");
  return pack(options);
}

}  // namespace tilepress
