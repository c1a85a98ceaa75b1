// Live picture: each picture is written whole and then takes the name of the one before.
#include "tilepress/live_picture.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "tilepress/block.h"
#include "tilepress/plane.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

constexpr uint64_t kMagic = 0x5443'4950'5054;  // "TPPICT\0\0", little-endian

uint64_t pixels_of(const LivePictureHead& head) {
  return head.blocks_x * kBlockSide * head.height;
}

uint64_t file_bytes(const LivePictureHead& head) {
  return sizeof head + pixels_of(head) * sizeof(uint32_t) +
         head.scheme_count * head.blocks_x * head.blocks_y * sizeof(uint16_t);
}

bool plausible(const LivePictureHead& head) {
  const auto blocks = [](uint64_t side) { return (side + kBlockSide - 1) / kBlockSide; };
  return head.magic == kMagic && head.version == kLivePictureVersion && head.head_bytes == sizeof head &&
         head.width >= 1 && head.width <= kMaxSurfaceSide && head.height >= 1 &&
         head.height <= kMaxSurfaceSide && head.blocks_x == blocks(head.width) &&
         head.blocks_y == blocks(head.height) && head.scheme_count <= head.state.scheme_count &&
         head.state.scheme_count <= kLiveSchemes && head.format < std::size(kFormatTraits) &&
         head.raw_bits > 0 && head.burst_bits > 0;
}

}  // namespace

int LivePictureWriter::write(const std::string& run_path, const LiveState& state, const SurfaceView& view,
                             const BlockBits& bits, uint32_t burst_bits) {
  const LivePictureHead head{.magic = kMagic,
                             .version = kLivePictureVersion,
                             .head_bytes = sizeof head,
                             .state = state,
                             .number = ++number_,
                             .width = view.width,
                             .height = view.height,
                             .format = static_cast<uint64_t>(view.format),
                             .blocks_x = bits.blocks_x,
                             .blocks_y = bits.blocks_y,
                             .raw_bits = bits.raw_bits,
                             .burst_bits = burst_bits,
                             .scheme_count = std::min<uint64_t>(bits.schemes.size(), state.scheme_count)};
  std::string file;
  file.reserve(file_bytes(head));
  const auto append = [&file](const auto* values, size_t count) {
    file.append(reinterpret_cast<const char*>(values), count * sizeof *values);
  };
  PixelPlane plane;
  plane.assign(view);
  append(&head, 1);
  append(plane.row(0), pixels_of(head));
  const std::vector<uint16_t> no_bits(head.blocks_x * head.blocks_y, kNoBlockBits);
  for (size_t i = 0; i < head.scheme_count; ++i)
    append((bits.schemes[i].empty() ? no_bits : bits.schemes[i]).data(), no_bits.size());
  path_ = run_path + "/" + kLivePictureFile;
  const std::string beside = path_ + ".tmp";
  int error = write_whole_bytes(beside, file, 0644) ? 0 : errno;
  // Some file systems write a file to the disk at once that replaces another.
  if (error == 0) unlink(path_.c_str());
  if (error == 0 && rename(beside.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) unlink(beside.c_str());
  return error;
}

void LivePictureWriter::close() {
  if (!path_.empty()) unlink(path_.c_str());
}

bool read_live_picture(const std::string& run_path, LivePicture& out) {
  std::ifstream file(run_path + "/" + kLivePictureFile, std::ios::binary | std::ios::ate);
  const std::streamoff bytes = file.tellg();
  const auto read = [&file](auto* values, size_t count) {
    return !!file.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof *values));
  };
  LivePicture picture;
  if (!file.seekg(0) || !read(&picture.head, 1) || !plausible(picture.head) ||
      static_cast<uint64_t>(bytes) != file_bytes(picture.head) || picture.head.number == out.head.number)
    return false;
  picture.pixels.resize(pixels_of(picture.head));
  bool whole = read(picture.pixels.data(), picture.pixels.size());
  picture.bits.resize(picture.head.scheme_count);
  for (std::vector<uint16_t>& counts : picture.bits) {
    counts.resize(picture.head.blocks_x * picture.head.blocks_y);
    whole &= read(counts.data(), counts.size());
    if (counts.front() == kNoBlockBits) counts.clear();
  }
  if (whole) out = std::move(picture);
  return whole;
}

}  // namespace tilepress
