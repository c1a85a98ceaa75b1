// Dumped frames: sizes come from frames.csv, pixels from the raw files.
#include "frames/dumped_frames.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "images/image_library.h"
#include "tilepress/run_reader.h"

namespace tilepress {

namespace fs = std::filesystem;

static Result<void> write_png(const fs::path& raw, const fs::path& png, const FrameStatistics& frame) {
  std::ifstream file(raw, std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  if (bytes.size() != size_t{frame.width} * frame.height * 4)
    return Error{ErrorKind::kFile, raw.string() + ": not " + std::to_string(frame.width) + "x" +
                                       std::to_string(frame.height) + " pixels"};
  const auto library = image_library();
  if (!library) return library.error();
  const PngPixels pixels{.width = frame.width,
                         .height = frame.height,
                         .channels = frame.format == PixelFormat::kRgba8 ? 4u : 3u,
                         .samples = bytes.data(),
                         .pixel_bytes = 4};
  const fs::path partial = png.string() + ".partial";  // so that every .png is whole
  std::error_code code;
  auto done = (*library)->write_png(partial.string(), pixels);
  if (done) fs::rename(partial, png, code);
  if (done && code) done = Error{ErrorKind::kFile, code.message()};
  if (done) return {};
  fs::remove(partial, code);
  return about(png.string(), done.error());
}

Result<void> convert_dumped_frames(const std::string& run_path) {
  const fs::path folder = fs::path(run_path) / "frames";
  std::error_code code;
  std::vector<fs::path> raws;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.path().extension() == ".rgba") raws.push_back(entry.path());
  if (raws.empty()) return {};
  const auto run = read_run(run_path);
  if (!run) return run.error();
  std::map<std::pair<unsigned long, unsigned long>, const FrameStatistics*> frames;
  for (const FrameStatistics& frame : run->frames) frames[{frame.surface, frame.frame}] = &frame;
  std::sort(raws.begin(), raws.end());
  for (const fs::path& raw : raws) {
    unsigned long surface = 0, number = 0;
    if (std::sscanf(raw.stem().c_str(), "%lu-%lu", &surface, &number) != 2) continue;
    const auto frame = frames.find({surface, number});
    // A frame without rows was cut off when its program ended. Its pixels may be cut off, too.
    if (frame == frames.end() || traits(frame->second->format).channel_bits[0] != 8) continue;
    fs::path png = raw;
    const auto written = write_png(raw, png.replace_extension(".png"), *frame->second);
    if (!written) return written;
    fs::remove(raw, code);
  }
  return {};
}

}  // namespace tilepress
