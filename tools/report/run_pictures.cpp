// Run pictures: box filter for thumbnails, PGM reader and a dark-to-yellow colour map for heat maps.
#include "run_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "images/image_library.h"
#include "images/image_readers.h"
#include "live/heat_colors.h"

namespace tilepress {
namespace {
namespace fs = std::filesystem;

constexpr uint32_t kShownSide = 240;
constexpr uint32_t kMaxSamples = 1u << 26;

std::string base64(const std::vector<uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= left ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// A data URI of an RGB picture; empty on failure.
std::string png_uri(const std::vector<uint8_t>& pixels, uint32_t width, uint32_t height) {
  const auto library = image_library();
  if (!library) return "";
  const std::vector<uint8_t> bytes =
      (*library)->encode_png({.width = width, .height = height, .channels = 3, .samples = pixels.data()});
  return bytes.empty() ? "" : "data:image/png;base64," + base64(bytes);
}

/// Shrinks an image to RGB. Each pixel is the mean of the pixels that it covers, without alpha.
std::vector<uint8_t> shrunk(const std::vector<uint8_t>& pixels, const ImageHeader& from, uint32_t to_width,
                            uint32_t to_height) {
  std::vector<uint8_t> small;
  small.reserve(size_t{to_width} * to_height * 3);
  for (uint32_t y = 0; y < to_height; ++y)
    for (uint32_t x = 0; x < to_width; ++x) {
      const uint32_t x0 = x * from.width / to_width, x1 = std::max(x0 + 1, (x + 1) * from.width / to_width);
      const uint32_t y0 = y * from.height / to_height, y1 = std::max(y0 + 1, (y + 1) * from.height / to_height);
      uint64_t sum[3] = {};
      for (uint32_t sy = y0; sy < y1; ++sy)
        for (uint32_t sx = x0; sx < x1; ++sx)
          for (size_t c = 0; c < 3; ++c)
            sum[c] += pixels[(size_t{sy} * from.width + sx) * from.channels + c];
      const uint64_t count = uint64_t{x1 - x0} * (y1 - y0);
      for (const uint64_t channel : sum) small.push_back(static_cast<uint8_t>((channel + count / 2) / count));
    }
  return small;
}

/// A data URI of the PNG at `path`, as large as `picture`; empty on failure.
std::string thumbnail_of(const std::string& path, const RunPicture& picture) {
  const OpenedImage opened = open_png(path);
  if (!opened || *opened == nullptr) return "";
  const ImageHeader header = (*opened)->images().front();
  if (header.channels < 3) return "";
  std::vector<uint8_t> pixels(size_t{header.width} * header.height * header.channels);
  if (!(*opened)->read(0, reinterpret_cast<std::byte*>(pixels.data()))) return "";
  return png_uri(shrunk(pixels, header, picture.width, picture.height), picture.width, picture.height);
}

/// Reads a heat map that FramePictures wrote. Returns false for other files.
bool read_heat_map(const std::string& path, HeatMap& out) {
  std::ifstream file(path, std::ios::binary);
  std::string magic, comment;
  uint32_t width = 0, height = 0;
  char space = 0;
  constexpr std::string_view kMark = "# scheme ";
  if (!std::getline(file, magic) || magic != "P5" || !std::getline(file, comment) ||
      !comment.starts_with(kMark))
    return false;
  if (!(file >> width >> height >> out.raw_bits) || !file.get(space) || out.raw_bits == 0) return false;
  const uint64_t count = uint64_t{width} * height;
  if (count == 0 || count > kMaxSamples) return false;
  std::vector<uint8_t> samples(count * 2);
  if (!file.read(reinterpret_cast<char*>(samples.data()), static_cast<std::streamsize>(samples.size())))
    return false;
  out.scheme = comment.substr(kMark.size());
  std::vector<uint8_t> pixels;
  pixels.reserve(count * 3);
  uint64_t sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t bits = samples[2 * i] * 256u + samples[2 * i + 1];
    sum += bits;
    out.most_bits = std::max(out.most_bits, bits);
    const auto color = heat_color(static_cast<double>(bits) / out.raw_bits);
    pixels.insert(pixels.end(), color.begin(), color.end());
  }
  out.mean_bits = static_cast<double>(sum) / static_cast<double>(count);
  out.image = png_uri(pixels, width, height);
  return !out.image.empty();
}

struct PictureFiles {
  std::string frame;
  std::vector<std::string> heat_maps;
};
using PictureKey = std::pair<uint64_t, uint32_t>;  // frame, surface

void list_folder(const fs::path& folder, bool heat, std::map<PictureKey, PictureFiles>& out) {
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    unsigned long surface = 0, frame = 0;
    if (std::sscanf(entry.path().filename().c_str(), "%lu-%lu", &surface, &frame) != 2) continue;
    PictureFiles& files = out[{frame, static_cast<uint32_t>(surface)}];
    if (heat && entry.path().extension() == ".pgm")
      files.heat_maps.push_back(entry.path().string());
    else if (!heat && entry.path().extension() == ".png")
      files.frame = entry.path().string();
  }
}

}  // namespace

std::vector<RunPicture> load_pictures(const RunRecord& run, size_t max_count) {
  std::map<PictureKey, PictureFiles> files;
  list_folder(fs::path(run.path) / "heatmaps", true, files);
  list_folder(fs::path(run.path) / "frames", false, files);
  std::map<PictureKey, const FrameStatistics*> rows;
  for (const FrameStatistics& frame : run.frames) rows[{frame.frame, frame.surface}] = &frame;
  std::erase_if(files, [&](const auto& entry) {
    return rows.count(entry.first) == 0 || (entry.second.frame.empty() && entry.second.heat_maps.empty());
  });
  std::vector<PictureKey> keys;
  for (const auto& [key, value] : files) keys.push_back(key);
  const size_t count = std::min(max_count, keys.size());
  std::vector<RunPicture> out;
  for (size_t i = 0; i < count; ++i) {
    const PictureKey key = keys[count == 1 ? keys.size() / 2 : i * (keys.size() - 1) / (count - 1)];
    const FrameStatistics& frame = *rows[key];
    const uint32_t longer = std::max(frame.width, frame.height);
    RunPicture picture{.frame = key.first, .surface = key.second, .thumbnail = "", .heat_maps = {}};
    picture.width = std::max(1u, static_cast<uint32_t>(uint64_t{frame.width} * kShownSide / longer));
    picture.height = std::max(1u, static_cast<uint32_t>(uint64_t{frame.height} * kShownSide / longer));
    if (!files[key].frame.empty()) picture.thumbnail = thumbnail_of(files[key].frame, picture);
    for (const std::string& path : files[key].heat_maps)
      if (HeatMap map; read_heat_map(path, map)) picture.heat_maps.push_back(std::move(map));
    const auto place = [&](const HeatMap& map) {
      return std::find(run.scheme_names.begin(), run.scheme_names.end(), map.scheme) -
             run.scheme_names.begin();
    };
    std::stable_sort(picture.heat_maps.begin(), picture.heat_maps.end(),
                     [&](const HeatMap& a, const HeatMap& b) { return place(a) < place(b); });
    out.push_back(std::move(picture));
  }
  return out;
}

std::string heat_scale_stops() {
  std::string out;
  for (size_t i = 0; i < kViridis.size(); ++i)
    out += fmt::format("<stop offset=\"{:.1f}%\" stop-color=\"rgb({},{},{})\"/>",
                       100.0 * static_cast<double>(i) / (kViridis.size() - 1), kViridis[i][0], kViridis[i][1],
                       kViridis[i][2]);
  return out;
}

}  // namespace tilepress
