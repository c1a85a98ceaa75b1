// OIIO images: the module of the image library. Each kind of file has its reader; OpenImageIO reads the rest.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fstream>

#include "images/image_errors.h"
#include "images/image_kind.h"
#include "images/image_library.h"
#include "images/image_readers.h"

namespace tilepress {
namespace {

/// Pages of a TIFF; 0 if their chain leads out of the file. OpenImageIO would take that for the last page.
uint32_t count_tiff_pages(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  unsigned char start[4] = {};
  file.read(reinterpret_cast<char*>(start), sizeof start);
  const bool big_endian = start[0] == 'M', wide = start[2] + start[3] == 43;
  const auto number = [&](uint32_t bytes) {
    uint64_t value = 0;
    for (uint32_t i = 0; i < bytes; ++i) {
      const auto byte = static_cast<uint64_t>(static_cast<unsigned char>(file.get()));
      value = big_endian ? value << 8 | byte : value | byte << (8 * i);
    }
    return value;
  };
  if (wide) file.seekg(8);
  constexpr uint32_t kMostPages = 65536;  // a chain may lead back
  for (uint32_t page = 0; page < kMostPages; ++page) {
    const uint64_t at = number(wide ? 8 : 4);
    if (!file) return 0;
    if (at == 0) return page;
    file.seekg(static_cast<std::streamoff>(at));
    const uint64_t entries = number(wide ? 8 : 2);
    if (!file || entries > UINT16_MAX) return 0;
    file.seekg(static_cast<std::streamoff>(entries * (wide ? 20 : 12)), std::ios::cur);
  }
  return 0;
}

/// Fails if the pixels cannot be taken as they are stored.
Result<ImageHeader> header_of(const OIIO::ImageSpec& spec) {
  if (spec.format != OIIO::TypeDesc::UINT8) return deep_channels(spec.format.c_str());
  if (spec.depth > 1) return unsupported("is a volume");
  // Of these TIFFs OpenImageIO computes RGB: inks (5) and Lab (8 to 10).
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", 2);
  if (photometric == 5 || (photometric >= 8 && photometric <= 10)) return unsupported("is not gray or RGB");
  if (spec.nchannels < 1 || spec.nchannels > 4)
    return unsupported("has " + std::to_string(spec.nchannels) + " channels, not 1 to 4");
  return ImageHeader{static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height),
                     static_cast<uint32_t>(spec.nchannels)};
}

class OiioFile final : public ImageFile {
 public:
  Result<void> open(const std::string& path, std::string_view plugin) {
    const uint32_t pages = plugin == "tiff" ? count_tiff_pages(path) : 1;
    if (pages == 0) return cut_off();
    OIIO::ImageSpec wishes, spec;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    input_ = OIIO::ImageInput::create(std::string(plugin));
    if (!input_) return library_error(OIIO::geterror());
    if (!input_->open(path, spec, wishes)) return library_error(input_->geterror());
    for (int page = 0; input_->seek_subimage(page, 0); ++page) {
      const auto header = header_of(input_->spec(page, 0));
      if (!header && page == 0) return header.error();
      if (!header) return about("image " + std::to_string(page), header.error());
      images_.push_back(*header);
    }
    input_->geterror();  // a seek past the last image leaves one
    if (images_.size() < pages)
      return Error{ErrorKind::kFile,
                   "is damaged or cut off: page " + std::to_string(images_.size()) + " cannot be read"};
    return {};
  }

  Result<void> read(uint32_t image, std::byte* out) override {
    const int channels = static_cast<int>(images_[image].channels);
    if (!input_->read_image(static_cast<int>(image), 0, 0, channels, OIIO::TypeDesc::UINT8, out))
      return library_error(input_->geterror());
    return {};
  }

 private:
  OIIO::ImageInput::unique_ptr input_;
};

class OiioLibrary final : public ImageLibrary {
 public:
  OpenedImage open(const std::string& path) const override {
    const ImageKind kind = image_kind_of_file(path.c_str());
    switch (kind.reader) {
      case ImageReader::kJpeg:
        return open_jpeg(path);
      case ImageReader::kGif:
        return open_gif(path);
      case ImageReader::kWebp:
        return open_webp(path);
      case ImageReader::kAvStill:
        return open_av_still(path, kind.name);
      case ImageReader::kOiio:
        return open_with<OiioFile>(path, kind.name);
      case ImageReader::kPng:  // an animation
        return open_apng(path);
      case ImageReader::kMovie:
        return open_movie(path);
      case ImageReader::kRefused:
        break;
    }
    return unsupported(std::string(kind.name) + " files are not read; convert it to PNG");
  }

  bool may_be_movie(std::string_view start) const override { return is_movie_start(start); }

  Result<void> write_png(const std::string& path, const PngPixels& pixels) const override {
    const auto output = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("png:compressionLevel", 4);
    if (!output) return library_error(OIIO::geterror());
    if (!output->open(path, spec) || !write(*output, pixels)) return library_error(output->geterror());
    return {};
  }

  std::vector<uint8_t> encode_png(const PngPixels& pixels) const override {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("png:compressionLevel", 9);
    if (!output || !output->set_ioproxy(&memory) || !output->open("memory.png", spec) ||
        !write(*output, pixels))
      return {};
    return bytes;
  }

 private:
  static OIIO::TypeDesc type_of(const PngPixels& pixels) {
    return pixels.channel_bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
  }
  static OIIO::ImageSpec spec_of(const PngPixels& pixels) {
    OIIO::ImageSpec spec(static_cast<int>(pixels.width), static_cast<int>(pixels.height),
                         static_cast<int>(pixels.channels), type_of(pixels));
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
  }
  static bool write(OIIO::ImageOutput& output, const PngPixels& pixels) {
    const OIIO::stride_t stride =
        pixels.pixel_bytes == 0 ? OIIO::AutoStride : static_cast<OIIO::stride_t>(pixels.pixel_bytes);
    return output.write_image(type_of(pixels), pixels.samples, stride) && output.close();
  }
};

}  // namespace
}  // namespace tilepress

extern "C" __attribute__((visibility("default"))) const tilepress::ImageLibrary* tilepress_image_library() {
  static const tilepress::OiioLibrary library;
  return &library;
}
