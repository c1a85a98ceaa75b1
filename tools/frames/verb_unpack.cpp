// tilepress unpack: restores the images of a packed file, or reads a part and counts the bursts.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "frames/image_writer.h"
#include "frames/packed_reader.h"
#include "progress_line.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_reader.h"
#include "verb.h"
#include "way_out.h"

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

std::optional<PixelRect> parse_rect(const std::string& text) {
  const auto values = parse_numbers<uint32_t, 4>(text, ',');
  if (!values || (*values)[2] == 0 || (*values)[3] == 0) return std::nullopt;
  return PixelRect{(*values)[0], (*values)[1], (*values)[2], (*values)[3]};
}

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

Result<void> write_part(const UnpackOptions& options, const Part& part, PixelFormat format) {
  const std::string path = part_path(options, part, format);
  if (options.format == "png")
    return write_png(path, part.words, part.rect.width, part.rect.height, format, options.force);
  return write_whole_file(path, native_bytes(part.words, format), options.force);
}

struct Row {
  const Part& part;
  const CompressedSurface& surface;
};
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("frame", row.part.number),
    TILEPRESS_CSV_FIGURE("scheme", row.surface.scheme.text),
    TILEPRESS_CSV_FIGURE("x", row.part.rect.x),
    TILEPRESS_CSV_FIGURE("y", row.part.rect.y),
    TILEPRESS_CSV_FIGURE("width", row.part.rect.width),
    TILEPRESS_CSV_FIGURE("height", row.part.rect.height),
    TILEPRESS_CSV_FIGURE("blocks", row.part.traffic.blocks),
    TILEPRESS_CSV_FIGURE("burst_bits", row.surface.burst_bits),
    TILEPRESS_CSV_FIGURE("payload_bursts", row.part.traffic.payload_bursts),
    TILEPRESS_CSV_FIGURE("csb_bursts", row.part.traffic.csb_bursts),
    TILEPRESS_CSV_FIGURE("table_bursts", row.part.traffic.table_bursts),
    TILEPRESS_CSV_FIGURE("raw_bursts", row.part.traffic.raw_bursts),
    TILEPRESS_CSV_FIGURE("csb_lookups", row.part.traffic.csb_lookups),
    TILEPRESS_CSV_FIGURE("csb_misses", row.part.traffic.csb_misses),
};

std::string csv_row(const Part& part, const CompressedSurface& surface) {
  std::string out;
  append_csv_row(kColumns, Row{part, surface}, out);
  return out;
}

std::string bursts_text(const Part& part, const CompressedSurface& surface) {
  const ReadTraffic& traffic = part.traffic;
  return fmt::format(
      "frame {}, {}x{} at {},{}, {}: {}, bursts of {} bits: payload {} + CSB {} + tables {} = {}, raw {}\n",
      part.number, part.rect.width, part.rect.height, part.rect.x, part.rect.y, surface.scheme.text,
      counted(traffic.blocks, "block"), surface.burst_bits, traffic.payload_bursts, traffic.csb_bursts,
      traffic.table_bursts, traffic.moved_bursts(), traffic.raw_bursts);
}

/// Reads the part of one surface that the options require.
Result<void> read_part(const CompressedSurface& surface, const UnpackOptions& options, Part& part) {
  part.rect = options.rect.value_or(PixelRect{0, 0, surface.width, surface.height});
  if (uint64_t{part.rect.x} + part.rect.width > surface.width ||
      uint64_t{part.rect.y} + part.rect.height > surface.height)
    return Error{ErrorKind::kBadValue,
                 fmt::format("--rect reaches beyond the surface of {}x{}", surface.width, surface.height)};
  SurfaceReader reader;
  if (const auto opened = reader.open(surface, options.read); !opened) return opened;
  if (!reader.read_rect(part.rect, part.words))
    return Error{ErrorKind::kBadBits, "bits that no encoder writes"};
  part.traffic = reader.traffic();
  return {};
}

/// Reads the wanted frames, and writes and prints what the options require. Returns the number of images
/// written.
Result<uint32_t> unpack_frames(PackedFileReader& packed, const UnpackOptions& options) {
  CompressedSurface surface;
  Part part;
  uint32_t written = 0;
  ProgressLine progress(options.quiet ? ProgressMode::kNever : ProgressMode::kAuto, "unpack");
  for (uint32_t number = 0; number < packed.count(); ++number) {
    if (options.frame ? number != *options.frame : !options.frames.contains(number)) continue;
    part.number = number;
    if (const auto read = packed.read(number, surface); !read) return about(options.file, read.error());
    if (const auto read = read_part(surface, options, part); !read)
      return about(options.file, about("surface " + std::to_string(number), read.error()));
    if (!options.output.empty()) {
      if (const auto wrote = write_part(options, part, surface.format); !wrote) return wrote.error();
      ++written;
    }
    if (options.csv)
      std::fputs(csv_row(part, surface).c_str(), stdout);
    else if (options.rect && !options.quiet)
      show(bursts_text(part, surface));
    progress.show(number + 1, packed.count());
  }
  return written;
}

int unpack(const UnpackOptions& options) {
  const auto file = open_packed_file(options.file);
  if (!file) return fail(kExitFailed, file.error());
  PackedFileReader& packed = (*file)->reader;
  if (options.frame && *options.frame >= packed.count())
    return fail(kExitFailed, fmt::format("{}: no frame {}, the file holds {}", options.file, *options.frame,
                                         counted(packed.count(), "frame")));
  if (!options.output.empty()) {
    std::error_code code;
    std::filesystem::create_directories(options.output, code);
    if (code) return fail(kExitFailed, options.output + ": " + code.message());
  }
  if (options.csv) std::fputs(csv_header(kColumns).c_str(), stdout);
  const auto written = unpack_frames(packed, options);
  if (!written) return fail(kExitFailed, written.error());
  if (!options.quiet && *written > 0)
    show(fmt::format("{}: {} restored into {}\n", options.file, counted(*written, "frame"), options.output));
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
                 "png, or raw: the pixels as memory holds them; rgba is the same as raw (default: png)")
      ->type_name("png|raw|rgba")
      ->check(CLI::IsMember({"png", "raw", "rgba"}));
  RunOptions run;
  add_run_option(app, run, "plugin", "Shared library with the file's scheme; repeat for more");
  add_frames_option(app, options.frames);
  app.add_option("--frame", options.frame, "Only this frame of the file, from 0")->type_name("N");
  app.add_option_function<std::string>(
         "--rect",
         [&](const std::string& text) {
           options.rect = parse_rect(text);
           if (!options.rect) throw CLI::ValidationError("--rect " + text + ": not X,Y,WIDTH,HEIGHT");
         },
         "Read only this part and print the bursts that the read takes")
      ->type_name("X,Y,W,H");
  add_read_options(app, options.read);
  app.add_flag("--csv", options.csv, "Print the bursts as CSV on standard output");
  app.add_flag("--force", options.force, "Replace images that exist");
  app.add_flag("-q,--quiet", options.quiet, "Print only errors");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (options.output.empty() && !options.rect && !options.csv)
    return fail(kExitUsage, "unpack: nothing to do; give -o DIR, --rect or --csv");
  for (const std::string& path : missing_paths({options.file})) return fail(kExitFailed, missing_text(path));
  return unpack(options);
}

}  // namespace tilepress
