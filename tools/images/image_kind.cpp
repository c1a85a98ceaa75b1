// Image kind: signatures of image files.
#include "images/image_kind.h"

#include <cstdint>
#include <cstdio>

namespace tilepress {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;
  size_t at;
  ImageKind kind;
};

constexpr Signature kSignatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, 0, {"png", ImageReader::kPng}},
    {"\xFF\xD8\xFF"sv, 0, {"jpeg", ImageReader::kJpeg}},
    {"GIF87a"sv, 0, {"gif", ImageReader::kGif}},
    {"GIF89a"sv, 0, {"gif", ImageReader::kGif}},
    {"WEBP"sv, 8, {"webp", ImageReader::kWebp}},
    {"II*\0"sv, 0, {"tiff", ImageReader::kOiio}},
    {"MM\0*"sv, 0, {"tiff", ImageReader::kOiio}},
    {"II+\0"sv, 0, {"tiff", ImageReader::kOiio}},
    {"MM\0+"sv, 0, {"tiff", ImageReader::kOiio}},
    {"\0\0\1\0"sv, 0, {"ico", ImageReader::kOiio}},
    {"\x76\x2f\x31\x01"sv, 0, {"openexr", ImageReader::kOiio}},
    {"#?RADIANCE"sv, 0, {"hdr", ImageReader::kOiio}},
    {"#?RGBE"sv, 0, {"hdr", ImageReader::kOiio}},
    {"8BPS"sv, 0, {"psd", ImageReader::kAvStill}},
    {"DDS "sv, 0, {"dds", ImageReader::kAvStill}},
    {"qoif"sv, 0, {"qoi", ImageReader::kAvStill}},
    {"SDPX"sv, 0, {"DPX", ImageReader::kRefused}},
    {"XPDS"sv, 0, {"DPX", ImageReader::kRefused}},
    {"\0\0\0\x0cjP  "sv, 0, {"JPEG 2000", ImageReader::kRefused}},
    {"\xFF\x4F\xFF\x51"sv, 0, {"JPEG 2000", ImageReader::kRefused}},
    {"\0\0\0\x0cJXL "sv, 0, {"JPEG XL", ImageReader::kRefused}},
    {"\xFF\x0A"sv, 0, {"JPEG XL", ImageReader::kRefused}},
    {"\x8AMNG"sv, 0, {"MNG", ImageReader::kRefused}},
    {"\x8BJNG"sv, 0, {"JNG", ImageReader::kRefused}},
    {"\xABKTX"sv, 0, {"KTX", ImageReader::kRefused}},
    {"8BPB"sv, 0, {"PSB", ImageReader::kRefused}},
};

uint32_t byte_at(std::string_view text, size_t at) { return static_cast<uint8_t>(text[at]); }

/// Brands of ISO files that hold images: all else after "ftyp" is a movie.
bool is_heif(std::string_view start) {
  if (start.size() < 12 || start.substr(4, 4) != "ftyp") return false;
  const std::string_view brand = start.substr(8, 4);
  for (const std::string_view image :
       {"avif", "avis", "heic", "heix", "heim", "heis", "hevc", "hevx", "hevm", "hevs", "mif1", "mif2", "msf1",
        "miaf", "jpeg", "jpgs"})
    if (brand == image) return true;
  return false;
}

bool is_bmp(std::string_view start) {
  if (start.size() < 18 || !start.starts_with("BM")) return false;
  const uint32_t header = byte_at(start, 14);
  return byte_at(start, 15) == 0 && byte_at(start, 16) == 0 && byte_at(start, 17) == 0 &&
         (header == 12 || header == 16 || header == 40 || header == 52 || header == 56 || header == 64 ||
          header == 108 || header == 124);
}

bool is_pnm(std::string_view start) {
  return start.size() > 3 && start[0] == 'P' && start[1] >= '1' && start[1] <= '7' &&
         std::string_view(" \t\r\n#").find(start[2]) != std::string_view::npos;
}

bool is_sgi(std::string_view start) {
  return start.size() > 6 && start.starts_with("\x01\xDA"sv) && byte_at(start, 2) <= 1 &&
         (byte_at(start, 3) == 1 || byte_at(start, 3) == 2) && byte_at(start, 4) == 0 &&
         byte_at(start, 5) >= 1 && byte_at(start, 5) <= 3;
}

/// A TGA has no signature: its header has few values that are valid, and zeros.
bool is_tga(std::string_view start) {
  if (start.size() < 18) return false;
  const bool has_map = byte_at(start, 1) == 1;
  const uint32_t type = byte_at(start, 2) & ~8u, bits = byte_at(start, 16);
  if (byte_at(start, 1) > 1 || byte_at(start, 2) > 11 || type < 1 || type > 3 || (type == 1) != has_map)
    return false;
  for (size_t at = 3; at < 8 && !has_map; ++at)
    if (start[at] != 0) return false;
  const uint32_t map_bits = byte_at(start, 7);
  if (has_map && map_bits != 15 && map_bits != 16 && map_bits != 24 && map_bits != 32) return false;
  return (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32) &&
         (byte_at(start, 12) | byte_at(start, 13)) != 0 && (byte_at(start, 14) | byte_at(start, 15)) != 0 &&
         (byte_at(start, 17) & 0xC0u) == 0;
}

}  // namespace

ImageKind image_kind(std::string_view start) {
  for (const Signature& each : kSignatures)
    if (start.size() >= each.at + each.bytes.size() && start.substr(each.at, each.bytes.size()) == each.bytes)
      return each.kind;
  if (is_heif(start)) return {"HEIF or AVIF", ImageReader::kRefused};
  if (is_bmp(start)) return {"bmp", ImageReader::kAvStill};
  if (is_pnm(start)) return {"pnm", ImageReader::kAvStill};
  if (is_sgi(start)) return {"sgi", ImageReader::kAvStill};
  if (is_tga(start)) return {"tga", ImageReader::kAvStill};
  return {};
}

ImageKind image_kind_of_file(const char* path) {
  std::FILE* file = std::fopen(path, "rbe");
  if (file == nullptr) return {};
  char start[kImageKindBytes];
  const size_t size = std::fread(start, 1, sizeof start, file);
  std::fclose(file);
  return image_kind({start, size});
}

}  // namespace tilepress
