// Frame pictures: heat maps as PGM, which every image program and numpy read; frames as raw pixels.
#include "tilepress/frame_pictures.h"

#include <sys/stat.h>

#include <cstring>

#include "tilepress/plane.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

std::string frame_stem(const FrameStatistics& frame) {
  std::string number = std::to_string(frame.frame);
  if (number.size() < 6) number.insert(0, 6 - number.size(), '0');
  return std::to_string(frame.surface) + "-" + number;
}

/// A scheme's name without characters that are special in paths and shells.
std::string file_part(const std::string& scheme) {
  std::string out;
  for (const char c : scheme) out += c == ':' || c == ',' || c == '/' ? '+' : c;
  return out;
}

}  // namespace

void FramePictures::open(const std::string& run_path, const RunOptions& options) {
  run_path_ = run_path;
  heatmaps_every_ = options.heatmaps_every;
  dump_every_ = options.dump_frames_every;
  scheme_names_.clear();
  for (const SchemeSpec& spec : options.schemes) scheme_names_.push_back(spec.text);
}

BlockBits* FramePictures::bits_for(uint64_t frame) {
  return heatmaps_every_ > 0 && frame % heatmaps_every_ == 0 ? &bits_ : nullptr;
}

Result<void> FramePictures::write(const FrameStatistics& frame, const SurfaceView& view) {
  if (bits_for(frame.frame) != nullptr)
    if (auto written = write_heat_maps(frame); !written) return written;
  if (dump_every_ == 0 || frame.frame % dump_every_ != 0) return {};
  const std::string folder = run_path_ + "/frames";
  mkdir(folder.c_str(), 0777);
  return write_raw_frame(folder + "/" + frame_stem(frame) + ".rgba", view);
}

Result<void> FramePictures::write_heat_maps(const FrameStatistics& frame) {
  const std::string folder = run_path_ + "/heatmaps";
  mkdir(folder.c_str(), 0777);
  for (size_t i = 0; i < bits_.schemes.size() && i < scheme_names_.size(); ++i) {
    if (bits_.schemes[i].empty()) continue;
    std::string bytes = "P5\n# scheme " + scheme_names_[i] + "\n" + std::to_string(bits_.blocks_x) + " " +
                        std::to_string(bits_.blocks_y) + "\n" + std::to_string(bits_.raw_bits) + "\n";
    for (const uint16_t bits : bits_.schemes[i]) {
      bytes += static_cast<char>(bits >> 8);
      bytes += static_cast<char>(bits & 0xFF);
    }
    const std::string path = folder + "/" + frame_stem(frame) + "-" + file_part(scheme_names_[i]) + ".pgm";
    if (auto written = write_whole_bytes(path, bytes); !written) return written;
  }
  return {};
}

Result<void> write_raw_frame(const std::string& path, const SurfaceView& view) {
  PixelPlane plane;
  plane.assign(view);
  const size_t pixel_bytes = traits(view.format).pixel_bits / 8;
  std::string bytes(size_t{plane.width()} * plane.height() * pixel_bytes, '\0');
  char* out = bytes.data();
  for (uint32_t y = 0; y < plane.height(); ++y)
    for (uint32_t x = 0; x < plane.width(); ++x, out += pixel_bytes)
      memcpy(out, plane.row(y) + x, pixel_bytes);
  return write_whole_bytes(path, bytes);
}

}  // namespace tilepress
