// Dumped frames: sizes come from frames.csv, pixels from the raw files.
#include "frames/dumped_frames.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "images/image_library.h"
#include "tilepress/run_reader.h"

namespace tilepress {
namespace {
namespace fs = std::filesystem;

bool write_png(const fs::path& raw, const fs::path& png, const FrameStatistics& frame, std::string& error) {
  std::ifstream file(raw, std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  if (bytes.size() != size_t{frame.width} * frame.height * 4) {
    error = raw.string() + ": not " + std::to_string(frame.width) + "x" + std::to_string(frame.height) +
            " pixels";
    return false;
  }
  const ImageLibrary* library = image_library(error);
  if (library == nullptr) return false;
  const PngPixels pixels{.width = frame.width,
                         .height = frame.height,
                         .channels = frame.format == PixelFormat::kRgba8 ? 4u : 3u,
                         .samples = bytes.data(),
                         .pixel_bytes = 4};
  const fs::path partial = png.string() + ".partial";  // whoever sees a PNG sees a whole one
  std::string reason;
  std::error_code code;
  if (library->write_png(partial.string(), pixels, reason)) {
    fs::rename(partial, png, code);
    if (!code) return true;
    reason = code.message();
  }
  fs::remove(partial, code);
  error = png.string() + ": " + reason;
  return false;
}

}  // namespace

bool convert_dumped_frames(const std::string& run_path, std::string& error) {
  const fs::path folder = fs::path(run_path) / "frames";
  std::error_code code;
  std::vector<fs::path> raws;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.path().extension() == ".rgba") raws.push_back(entry.path());
  if (raws.empty()) return true;
  const auto run = read_run(run_path);
  if (!run) return error = run.error().text, false;
  std::map<std::pair<unsigned long, unsigned long>, const FrameStatistics*> frames;
  for (const FrameStatistics& frame : run->frames) frames[{frame.surface, frame.frame}] = &frame;
  std::sort(raws.begin(), raws.end());
  for (const fs::path& raw : raws) {
    unsigned long surface = 0, number = 0;
    if (std::sscanf(raw.stem().c_str(), "%lu-%lu", &surface, &number) != 2) continue;
    const auto frame = frames.find({surface, number});
    // A frame without rows was cut off with its program: its pixels may be, too.
    if (frame == frames.end() || traits(frame->second->format).channel_bits[0] != 8) continue;
    fs::path png = raw;
    if (!write_png(raw, png.replace_extension(".png"), *frame->second, error)) return false;
    fs::remove(raw, code);
  }
  return true;
}

}  // namespace tilepress
