// tilepress vectors: test vectors for hardware, as files for $readmemh.
#include <fmt/format.h>

#include <filesystem>

#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "frames/image_frames.h"
#include "streams/output_file.h"
#include "tilepress/scheme.h"
#include "vectors/vector_frames.h"
#include "vectors/vectors_readme.h"
#include "verb.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "DIR gets a folder per frame: pixels, CSB, payload and its bit count of each block, the tables, and for\n"
    "schemes with an FVC the CCD before the frame and the FVC before and after it. README.md in DIR has the\n"
    "layout. A block takes about 1.2 KB.\n"
    "\n"
    "Examples:\n"
    "  tilepress vectors -s vdcp shots/*.png -o vectors\n"
    "  tilepress vectors -s vdcp --write 1-2 --blocks 100 shots/*.png -o vectors    a hundred blocks of two "
    "frames\n"
    "  tilepress vectors -s ras --tile 8 --first 460 --blocks 1 shot.png -o one        one block\n"
    "\n"
    "Test a decoder: feed ccd.hex once, then csb.hex and payload.hex line by line, and compare with "
    "pixels.hex.\n"
    "Test an FVC: load fvc_before_blocks.hex, feed pixels.hex, and compare with fvc_after_blocks.hex.\n"
    "Frame 0 has no CCD: the DCP schemes store it raw.\n";

struct VectorsOptions {
  RunOptions run;
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  PixelFormat raw_format = PixelFormat::kRgba8;
  BlockWindow window;
  FrameSet written;
  std::string output;
  bool quiet = false;
};

/// The folder of -o and the folders in it. Unless keep() is called, all that was made is removed.
class VectorFolders {
 public:
  ~VectorFolders() {
    std::error_code code;
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove_all(*folder, code);
  }
  /// Makes a folder. An existing folder must be empty.
  Result<void> make(const std::string& path) {
    std::error_code code;
    const bool exists = fs::exists(path, code);
    if (exists && !fs::is_directory(path, code))
      return Error{ErrorKind::kExists, path + ": not a folder; name another one with -o"};
    if (exists && !fs::is_empty(path, code))
      return Error{ErrorKind::kExists, path + ": the folder is not empty; name another one with -o"};
    fs::create_directories(path, code);
    if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
    if (!exists) made_.push_back(path);
    return {};
  }
  void keep() { made_.clear(); }

 private:
  std::vector<std::string> made_;
};

/// Models the frames and writes those that the options choose.
Result<std::vector<VectorFrame>> write_frames(ImageFrames& images, const VectorsOptions& options,
                                              VectorFrames& vectors, VectorFolders& folders) {
  std::vector<VectorFrame> written;
  const auto last_read = options.run.frames.last(), last_written = options.written.last();
  ImageFrame frame;
  for (uint64_t number = 0;
       (!last_read || number <= *last_read) && (!last_written || number <= *last_written); ++number) {
    const auto read = images.read(number, frame);
    if (!read) return read.error();
    if (!*read) break;
    if (!options.run.takes(number)) continue;
    if (const auto modelled = vectors.model(images.view(frame), number); !modelled) return modelled.error();
    const bool wanted = options.written.contains(number);
    const std::string folder = wanted ? options.output + "/" + vector_folder(number) : "";
    if (wanted)
      if (const auto made = folders.make(folder); !made) return made.error();
    const auto done = vectors.write(folder);
    if (!done) return done.error();
    if (wanted) written.push_back(*done);
  }
  return written;
}

int vectors(const VectorsOptions& options) {
  ImageFrames images;
  if (const auto opened = images.open(options.images, options.size, options.raw_format); !opened)
    return fail(kExitFailed, opened.error());
  const SchemeSpec& scheme = options.run.schemes.front();
  if (const auto lines = unsupported_schemes(options.run.schemes, images.format()); !lines.empty())
    return fail(kExitFailed, lines.front());
  const FrameSize size = images.size();
  const uint64_t blocks =
      uint64_t{(size.width + kBlockSide - 1) / kBlockSide} * ((size.height + kBlockSide - 1) / kBlockSide);
  if (options.window.first >= blocks)
    return fail(kExitFailed, fmt::format("--first {}: a frame of {} has {}, numbered from 0",
                                         options.window.first, size.text(), counted(blocks, "block")));
  VectorFolders folders;
  if (const auto made = folders.make(options.output); !made) return fail(kExitFailed, made.error());
  VectorFrames frames(scheme, options.run.model, images.format(), options.window);
  const auto written = write_frames(images, options, frames, folders);
  if (!written) return fail(kExitFailed, written.error());
  if (written->empty())
    return fail(kExitNothingCaptured, "no frame to write: --frames, --every and --write leave none");
  const std::string readme = vectors_readme(*written, frames.surface());
  if (const auto done = write_whole_file(options.output + "/README.md", readme, false); !done)
    return fail(kExitFailed, done.error());
  folders.keep();
  if (!options.quiet)
    show(fmt::format("{}: {} of {}, {} a frame, {}; README.md has the layout\n", options.output,
                     counted(written->size(), "frame"), size.text(),
                     counted(written->front().blocks, "block"), scheme.text));
  return kExitDone;
}

/// Returns the line about a scheme that has no vectors, or nothing.
std::optional<std::string> refusal(const std::vector<SchemeSpec>& schemes) {
  if (schemes.size() != 1) return "--scheme: vectors are of one scheme; give one -s";
  const std::string& name = schemes.front().name;
  if (!find_scheme(name)->needs_frame_before) return std::nullopt;
  return "--scheme " + name + ": its blocks cannot be restored without the frame before; give another scheme";
}

}  // namespace

int verb_vectors(int argc, char** argv) {
  CLI::App app("Writes test vectors for hardware: files for $readmemh with the blocks of images.");
  app.footer(kExamples);
  VectorsOptions options;
  options.run.output = "-";
  options.run.schemes = {*parse_scheme("vdcp")};
  options.run.model.verify = true;
  options.run.model.frame_metrics = false;
  app.add_option("IMAGE", options.images, "Images or movies of 8 bits a channel, or raw files")
      ->type_name("...")
      ->required();
  app.add_option("-o,--output", options.output, "Folder for the files; new or empty")
      ->type_name("DIR")
      ->required();
  add_model_options(app, options.run, "One scheme as name:key=value,... (default: vdcp)");
  add_frames_option(app, options.written, "write",
                    "Write only these frames; the frames before them are modelled (default: all)");
  app.add_option("--first", options.window.first,
                 "First block to write, in the order of commitment (default: 0)")
      ->type_name("N");
  app.add_option("--blocks", options.window.count, "Blocks to write of each frame (default: all)")
      ->type_name("N")
      ->check([](const std::string& text) { return text == "0" ? "must be at least 1" : ""; });
  add_size_option(app, "size", options.size, "Size of raw frames");
  add_raw_format_option(app, options.raw_format);
  app.add_flag("-q,--quiet", options.quiet, "Print no summary");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.raw_format != PixelFormat::kRgba8 && !options.size)
    return fail(kExitUsage, "--format: raw frames need --size WxH");
  if (const auto line = refusal(options.run.schemes)) return fail(kExitUsage, *line);
  return vectors(options);
}

}  // namespace tilepress
