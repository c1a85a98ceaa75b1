// Frame pictures: PGM for heat maps, so that any image program and numpy read them; raw pixels for frames.
#include "tilepress/frame_pictures.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "run/descriptors.h"
#include "tilepress/plane.h"

namespace tilepress {
namespace {

bool write_file(const std::string& path, const std::string& bytes) {
  const int file = open_above_streams(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (file < 0) return false;
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<size_t>(written);
  }
  const int error = errno;
  close(file);
  errno = error;
  return done == bytes.size();
}

std::string frame_stem(const FrameStatistics& frame) {
  std::string number = std::to_string(frame.frame);
  if (number.size() < 6) number.insert(0, 6 - number.size(), '0');
  return std::to_string(frame.surface) + "-" + number;
}

/// A scheme's name without what folders and shells take amiss.
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

bool FramePictures::write(const FrameStatistics& frame, const SurfaceView& view) {
  if (bits_for(frame.frame) != nullptr && !write_heat_maps(frame)) return false;
  if (dump_every_ == 0 || frame.frame % dump_every_ != 0) return true;
  const std::string folder = run_path_ + "/frames", path = folder + "/" + frame_stem(frame) + ".rgba";
  mkdir(folder.c_str(), 0777);
  if (write_raw_frame(path, view)) return true;
  error_ = path + ": " + std::strerror(errno);
  return false;
}

bool FramePictures::write_heat_maps(const FrameStatistics& frame) {
  const std::string folder = run_path_ + "/heatmaps";
  mkdir(folder.c_str(), 0777);
  for (size_t i = 0; i < bits_.schemes.size() && i < scheme_names_.size(); ++i) {
    std::string bytes = "P5\n# scheme " + scheme_names_[i] + "\n" + std::to_string(bits_.blocks_x) + " " +
                        std::to_string(bits_.blocks_y) + "\n" + std::to_string(bits_.raw_bits) + "\n";
    for (const uint16_t bits : bits_.schemes[i]) {
      bytes += static_cast<char>(bits >> 8);
      bytes += static_cast<char>(bits & 0xFF);
    }
    const std::string path = folder + "/" + frame_stem(frame) + "-" + file_part(scheme_names_[i]) + ".pgm";
    if (write_file(path, bytes)) continue;
    error_ = path + ": " + std::strerror(errno);
    return false;
  }
  return true;
}

bool write_raw_frame(const std::string& path, const SurfaceView& view) {
  PixelPlane plane;
  plane.assign(view);
  const size_t pixel_bytes = traits(view.format).pixel_bits / 8;
  std::string bytes(size_t{plane.width()} * plane.height() * pixel_bytes, '\0');
  char* out = bytes.data();
  for (uint32_t y = 0; y < plane.height(); ++y)
    for (uint32_t x = 0; x < plane.width(); ++x, out += pixel_bytes)
      memcpy(out, plane.row(y) + x, pixel_bytes);
  return write_file(path, bytes);
}

}  // namespace tilepress
