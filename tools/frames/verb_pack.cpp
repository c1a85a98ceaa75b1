// tilepress pack: images to a file of compressed surfaces.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "command_line.h"
#include "common_options.h"
#include "frames/image_frames.h"
#include "frames/packed_file.h"
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
    "The first frame of a sequence has no dictionary yet: the DCP family stores it raw.\n";

struct PackOptions {
  RunOptions run;
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  std::optional<PixelFormat> native;  ///< set: all inputs are raw files of this format
  std::string output;
  bool force = false;
  bool quiet = false;
};

/// The frames of raw files of RGB565 or RGB10A2; or what ImageFrames reads.
class PackSource {
 public:
  bool open(const PackOptions& options, std::string& error) {
    native_ = options.native;
    paths_ = options.images;
    if (!native_) return images_.open(options.images, options.size, error);
    size_ = *options.size;
    for (const std::string& path : paths_) {
      std::error_code code;
      const uint64_t bytes = std::filesystem::file_size(path, code);
      if (code) error = path + ": " + code.message();
      if (!code && bytes != frame_bytes())
        error = path + ": " + std::to_string(bytes) + " bytes, a raw frame of this size and format has " +
                std::to_string(frame_bytes());
      if (!error.empty()) return false;
    }
    return true;
  }
  FrameSize size() const { return native_ ? size_ : images_.size(); }
  PixelFormat format() const { return native_ ? *native_ : images_.format(); }
  ImageFrames::Outcome read(uint64_t index, ImageFrame& out, std::string& error) {
    if (!native_) return images_.read(index, out, error);
    if (index >= paths_.size()) return ImageFrames::Outcome::kEnd;
    out.pixels.resize(frame_bytes());
    std::ifstream file(paths_[index], std::ios::binary);
    if (file.read(reinterpret_cast<char*>(out.pixels.data()), static_cast<std::streamsize>(frame_bytes())))
      return ImageFrames::Outcome::kFrame;
    error = paths_[index] + ": cannot be read";
    return ImageFrames::Outcome::kFailed;
  }

 private:
  uint64_t frame_bytes() const {
    return uint64_t{size_.width} * size_.height * traits(*native_).pixel_bits / 8;
  }
  ImageFrames images_;
  std::optional<PixelFormat> native_;
  std::vector<std::string> paths_;
  FrameSize size_;
};

struct PackTotals {
  uint64_t frames = 0;
  SchemeStatistics all, measured;  ///< measured: without the first frame
};

bool pack_frames(PackSource& source, const PackOptions& options, PackedFileWriter& writer, PackTotals& totals,
                 std::string& error) {
  SurfaceEngine engine(options.run.schemes, options.run.model);
  const FrameSize size = source.size();
  const auto pitch = static_cast<ptrdiff_t>(size.width * (traits(source.format()).pixel_bits / 8));
  ImageFrame frame;
  FrameStatistics statistics;
  CompressedSurface surface;
  for (uint64_t number = 0;; ++number) {
    const auto last = options.run.frames.last();
    if (last && number > *last) return true;
    const auto outcome = source.read(number, frame, error);
    if (outcome == ImageFrames::Outcome::kFailed) return false;
    if (outcome == ImageFrames::Outcome::kEnd) return true;
    if (!options.run.takes(number)) continue;
    const SurfaceView view{frame.pixels.data(), pitch,           size.width,
                           size.height,         source.format(), ByteOrder::kNative};
    engine.process(view, statistics, std::span(&surface, 1));
    const SchemeStatistics& scheme = statistics.schemes.front();
    if (scheme.mismatched_blocks > 0) {
      error = "--verify: " + surface.scheme.text + ": frame " + std::to_string(number) + ": " +
              std::to_string(scheme.mismatched_blocks) + " blocks differ after decoding";
      return false;
    }
    if (!writer.append(surface)) {
      error = options.output + ": " + std::strerror(errno);
      return false;
    }
    ++totals.frames;
    totals.all += scheme;
    if (!statistics.warmup) totals.measured += scheme;
  }
}

void print_summary(const PackOptions& options, const PackSource& source, const PackTotals& totals) {
  std::error_code code;
  const uint64_t file_bytes = std::filesystem::file_size(options.output, code);
  std::fprintf(stderr, "%s: %llu frames of %ux%u %.*s, %s\n", options.output.c_str(),
               static_cast<unsigned long long>(totals.frames), source.size().width, source.size().height,
               static_cast<int>(traits(source.format()).name.size()), traits(source.format()).name.data(),
               options.run.schemes.front().text.c_str());
  const auto bytes = [](uint64_t bits) { return static_cast<unsigned long long>((bits + 7) / 8); };
  std::fprintf(stderr, "  raw      %12llu bytes\n", bytes(totals.all.raw_bits));
  std::fprintf(stderr, "  payload  %12llu bytes, CSB %llu, tables %llu; in bursts %llu\n",
               bytes(totals.all.payload_bits), bytes(totals.all.csb_bits), bytes(totals.all.palette_bits),
               bytes(totals.all.moved_bits()));
  std::fprintf(stderr, "  file     %12llu bytes\n", static_cast<unsigned long long>(file_bytes));
  if (totals.measured.raw_bits > 0)
    std::fprintf(stderr, "  rate     %12.3f without the first frame\n", totals.measured.rate());
}

int pack(const PackOptions& options) {
  std::string error;
  PackSource source;
  PendingFile pending;
  if (!pending.begin(options.output, options.force, error)) return fail(kExitFailed, error);
  if (!source.open(options, error)) return fail(kExitFailed, error);
  std::ofstream file(pending.path(), std::ios::binary | std::ios::trunc);
  if (!file) return fail(kExitFailed, options.output + ": " + std::strerror(errno));
  PackedFileWriter writer(file);
  PackTotals totals;
  bool packed = pack_frames(source, options, writer, totals, error);
  if (packed && totals.frames == 0) {
    error = "no frame to pack";
    packed = false;
  }
  if (packed && !writer.finish()) {
    error = options.output + ": " + std::strerror(errno);
    packed = false;
  }
  file.close();
  if (packed && !file) {
    error = options.output + ": " + std::strerror(errno);
    packed = false;
  }
  if (!packed || !pending.commit(error))
    return fail(totals.frames == 0 && error == "no frame to pack" ? kExitNothingCaptured : kExitFailed,
                error);
  if (!options.quiet) print_summary(options, source, totals);
  return kExitDone;
}

}  // namespace

int verb_pack(int argc, char** argv) {
  CLI::App app("Writes images as compressed surfaces, real bits, to a file that unpack and compose read.");
  app.footer(kExamples);
  PackOptions options;
  options.run.output = "-";
  options.run.schemes = {*parse_scheme("vdcp")};
  app.add_option("IMAGE", options.images, "Images or movies of 8 bits a channel, or raw files")
      ->type_name("...")
      ->required();
  app.add_option("-o,--output", options.output, "File to write")->type_name("FILE")->required();
  add_model_options(app, options.run, "One scheme as name:key=value,... (default: vdcp)");
  add_run_option(app, options.run, "verify", "Decode every block again and compare; a mismatch is exit 1");
  add_size_option(app, "size", options.size, "Size of raw frames");
  app.add_option_function<std::string>(
         "--format",
         [&](const std::string& text) {
           if (text == "rgb565") options.native = PixelFormat::kRgb565;
           if (text == "rgb10a2") options.native = PixelFormat::kRgb10a2;
           if (text != "rgba" && !options.native)
             throw CLI::ValidationError("--format " + text + ": not one of rgba, rgb565, rgb10a2");
         },
         "What raw frames hold: rgba (.rgba files), rgb565 or rgb10a2 (default: rgba)")
      ->type_name("NAME");
  app.add_flag("--force", options.force, "Replace the file");
  app.add_flag("-q,--quiet", options.quiet, "No summary");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.native && !options.size) return fail(kExitUsage, "--format: raw frames need --size WxH");
  if (options.run.schemes.size() != 1) return fail(kExitUsage, "--scheme: a packed file holds one scheme");
  const std::string& name = options.run.schemes.front().name;
  if (find_scheme(name)->needs_frame_before)
    return fail(kExitUsage, "--scheme " + name + ": its frames are not complete without the frame before");
  return pack(options);
}

}  // namespace tilepress
