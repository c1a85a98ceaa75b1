// tilepress unpack: the images of a packed file, or a part of one with the bursts it takes.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "command_line.h"
#include "common_options.h"
#include "frames/image_writer.h"
#include "frames/packed_file.h"
#include "frames/read_options.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_reader.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress unpack shots.tpk -o images\n"
    "  tilepress unpack shots.tpk --rect 100,40,64,64 --frame 3\n"
    "  tilepress unpack shots.tpk --rect 0,0,1280,8 --csv > reads.csv\n";

struct UnpackOptions {
  std::string file;
  std::string output;
  std::string format = "png";
  FrameSet frames;
  std::optional<uint64_t> frame;
  std::optional<PixelRect> rect;
  ReadOptions read;
  bool csv = false;
  bool force = false;
  bool quiet = false;
};

struct Part {
  uint32_t number = 0;
  PixelRect rect;
  std::vector<uint32_t> words;
  ReadTraffic traffic;
};

/// DIR/000003.png, or DIR/000003-100,40,64,64.png for a part.
std::string part_path(const UnpackOptions& options, const Part& part, PixelFormat format) {
  char name[96];
  int length = std::snprintf(name, sizeof name, "%06u", part.number);
  if (options.rect)
    std::snprintf(name + length, sizeof name - static_cast<size_t>(length), "-%u,%u,%u,%u", part.rect.x,
                  part.rect.y, part.rect.width, part.rect.height);
  return options.output + "/" + name + "." + (options.format == "png" ? "png" : raw_extension(format));
}

bool write_part(const UnpackOptions& options, const Part& part, PixelFormat format, std::string& error) {
  const std::string path = part_path(options, part, format);
  if (options.format == "png")
    return write_png(path, part.words, part.rect.width, part.rect.height, format, options.force, error);
  return write_whole_file(path, native_bytes(part.words, format), options.force, error);
}

void report_part(const UnpackOptions& options, const Part& part, const CompressedSurface& surface) {
  const ReadTraffic& traffic = part.traffic;
  const auto number = [](uint64_t value) { return static_cast<unsigned long long>(value); };
  if (options.csv)
    std::printf("%u,%s,%u,%u,%u,%u,%llu,%u,%llu,%llu,%llu,%llu,%llu,%llu\n", part.number,
                csv_field(surface.scheme.text).c_str(), part.rect.x, part.rect.y, part.rect.width,
                part.rect.height, number(traffic.blocks), surface.burst_bits, number(traffic.payload_bursts),
                number(traffic.csb_bursts), number(traffic.table_bursts), number(traffic.raw_bursts),
                number(traffic.csb_lookups), number(traffic.csb_misses));
  else if (!options.quiet)
    std::fprintf(
        stderr,
        "frame %u, %ux%u at %u,%u, %s: %llu blocks, bursts of %u bits: payload %llu + CSB %llu + tables "
        "%llu = %llu, raw %llu\n",
        part.number, part.rect.width, part.rect.height, part.rect.x, part.rect.y, surface.scheme.text.c_str(),
        number(traffic.blocks), surface.burst_bits, number(traffic.payload_bursts),
        number(traffic.csb_bursts), number(traffic.table_bursts), number(traffic.moved_bursts()),
        number(traffic.raw_bursts));
}

/// Reads the part of one surface. False and one line in `error`.
bool read_part(const CompressedSurface& surface, const UnpackOptions& options, Part& part,
               std::string& error) {
  part.rect = options.rect.value_or(PixelRect{0, 0, surface.width, surface.height});
  if (uint64_t{part.rect.x} + part.rect.width > surface.width ||
      uint64_t{part.rect.y} + part.rect.height > surface.height) {
    error = "--rect reaches beyond the surface of " + std::to_string(surface.width) + "x" +
            std::to_string(surface.height);
    return false;
  }
  SurfaceReader reader;
  if (const auto opened = reader.open(surface, options.read); !opened) {
    error = opened.error().text;
    return false;
  }
  if (!reader.read_rect(part.rect, part.words)) {
    error = "bits that no encoder writes";
    return false;
  }
  part.traffic = reader.traffic();
  return true;
}

int unpack(const UnpackOptions& options) {
  std::string error;
  errno = 0;
  std::ifstream file(options.file, std::ios::binary);
  if (!file || std::filesystem::is_directory(options.file))
    return fail(kExitFailed, options.file + ": " + (file ? "is a folder" : std::strerror(errno)));
  PackedFileReader packed;
  if (!packed.open(file, error)) return fail(kExitFailed, options.file + ": " + error);
  if (options.frame && *options.frame >= packed.count())
    return fail(kExitFailed, options.file + ": no frame " + std::to_string(*options.frame) + ", it holds " +
                                 std::to_string(packed.count()));
  if (!options.output.empty()) {
    std::error_code code;
    std::filesystem::create_directories(options.output, code);
    if (code) return fail(kExitFailed, options.output + ": " + code.message());
  }
  if (options.csv)
    std::printf(
        "frame,scheme,x,y,width,height,blocks,burst_bits,payload_bursts,csb_bursts,table_bursts,raw_bursts,"
        "csb_lookups,csb_misses\n");
  CompressedSurface surface;
  Part part;
  uint32_t written = 0;
  for (uint32_t number = 0; number < packed.count(); ++number) {
    if (options.frame ? number != *options.frame : !options.frames.contains(number)) continue;
    part.number = number;
    if (!packed.read(number, surface, error)) return fail(kExitFailed, options.file + ": " + error);
    if (!read_part(surface, options, part, error))
      return fail(kExitFailed, options.file + ": surface " + std::to_string(number) + ": " + error);
    if (!options.output.empty()) {
      if (!write_part(options, part, surface.format, error)) return fail(kExitFailed, error);
      ++written;
    }
    if (options.rect || options.csv) report_part(options, part, surface);
  }
  if (!options.quiet && written > 0)
    std::fprintf(stderr, "%s: %u frames restored into %s\n", options.file.c_str(), written,
                 options.output.c_str());
  return kExitDone;
}

}  // namespace

int verb_unpack(int argc, char** argv) {
  CLI::App app("Restores the images of a packed file bit for bit, or reads a part and counts the bursts.");
  app.footer(kExamples);
  UnpackOptions options;
  app.add_option("FILE", options.file, "A file that tilepress pack wrote")->type_name("FILE")->required();
  app.add_option("-o,--output", options.output, "Folder for the images")->type_name("DIR");
  app.add_option("--format", options.format,
                 "png, or raw: the pixels as memory holds them (rgba is the same; default: png)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"png", "raw", "rgba"}));
  add_frames_option(app, options.frames);
  app.add_option("--frame", options.frame, "Only this frame of the file, from 0")->type_name("N");
  app.add_option_function<std::string>(
         "--rect",
         [&](const std::string& text) {
           options.rect = parse_rect(text);
           if (!options.rect) throw CLI::ValidationError("--rect " + text + ": not X,Y,WIDTH,HEIGHT");
         },
         "Read only this part and tell the bursts it takes")
      ->type_name("X,Y,W,H");
  add_read_options(app, options.read);
  app.add_flag("--csv", options.csv, "The bursts as CSV on standard output");
  app.add_flag("--force", options.force, "Replace images that are there");
  app.add_flag("-q,--quiet", options.quiet, "Say nothing when all is well");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.output.empty() && !options.rect && !options.csv)
    return fail(kExitUsage, "unpack: neither -o DIR nor --rect nor --csv: nothing to do");
  return unpack(options);
}

}  // namespace tilepress
