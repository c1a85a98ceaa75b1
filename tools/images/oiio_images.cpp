// OIIO images: the image library, as a module: each kind of file has its reader, OpenImageIO the rest.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fstream>

#include "images/av_still.h"
#include "images/gif_image.h"
#include "images/image_kind.h"
#include "images/image_library.h"
#include "images/jpeg_image.h"
#include "images/movie_file.h"
#include "images/webp_image.h"

namespace tilepress {
namespace {

/// Pages of a TIFF; 0 if their chain leads out of the file, which OpenImageIO takes for its end.
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

class OiioFile final : public ImageFile {
 public:
  OiioFile(OIIO::ImageInput::unique_ptr input, uint32_t pages)
      : input_(std::move(input)), pages_(pages) {}

  bool header(uint32_t image, ImageHeader& out, std::string& reason) override {
    if (!input_->seek_subimage(static_cast<int>(image), 0)) {
      input_->geterror();  // a seek past the last image leaves one
      if (image < pages_) reason = "is damaged or cut off: page " + std::to_string(image) + " cannot be read";
      return false;
    }
    const OIIO::ImageSpec spec = input_->spec(static_cast<int>(image), 0);
    out = {.width = static_cast<uint32_t>(spec.width),
           .height = static_cast<uint32_t>(spec.height),
           .channels = static_cast<uint32_t>(spec.nchannels),
           .refusal = refusal(spec)};
    return true;
  }

  bool read(uint32_t image, uint32_t channels, std::byte* out, std::string& reason) override {
    if (input_->read_image(static_cast<int>(image), 0, 0, static_cast<int>(channels), OIIO::TypeDesc::UINT8,
                           out))
      return true;
    reason = input_->geterror();
    return false;
  }

 private:
  static std::string refusal(const OIIO::ImageSpec& spec) {
    if (spec.format != OIIO::TypeDesc::UINT8) return deep_refusal(spec.format.c_str());
    if (spec.depth > 1) return "is a volume";
    // Of these TIFFs OpenImageIO computes RGB: inks (5) and Lab (8 to 10).
    const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", 2);
    if (photometric == 5 || (photometric >= 8 && photometric <= 10)) return "is not gray or RGB";
    return {};
  }
  OIIO::ImageInput::unique_ptr input_;
  const uint32_t pages_;  ///< at least so many images
};

class OiioLibrary final : public ImageLibrary {
 public:
  std::unique_ptr<ImageFile> open(const std::string& path, std::string& reason) const override {
    const ImageKind kind = image_kind_of_file(path.c_str());
    switch (kind.reader) {
      case ImageReader::kJpeg:
        return open_jpeg(path, reason);
      case ImageReader::kGif:
        return open_gif(path, reason);
      case ImageReader::kWebp:
        return open_webp(path, reason);
      case ImageReader::kAvStill:
        return open_av_still(path, kind.name, reason);
      case ImageReader::kOiio:
        return open_oiio(path, kind.name, reason);
      case ImageReader::kRefused:
        reason = std::string(kind.name) + " files are not read; convert it to PNG";
        return nullptr;
      case ImageReader::kPng:  // an animated one
        return open_apng(path, reason);
      case ImageReader::kMovie:
        return open_movie(path, reason);
    }
    return nullptr;
  }

  bool may_be_movie(std::string_view start) const override { return is_movie_start(start); }

  bool write_png(const std::string& path, const PngPixels& pixels, std::string& reason) const override {
    const auto output = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("png:compressionLevel", 4);  // files grow by 4 % at most; the default takes twice as long
    if (output && output->open(path, spec) && write(*output, pixels)) return true;
    reason = output ? output->geterror() : OIIO::geterror();
    return false;
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
  static std::unique_ptr<ImageFile> open_oiio(const std::string& path, std::string_view plugin,
                                              std::string& reason) {
    OIIO::ImageSpec wishes, spec;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const uint32_t pages = plugin == "tiff" ? count_tiff_pages(path) : 1;
    if (pages == 0) {
      reason = "is cut off";
      return nullptr;
    }
    auto input = OIIO::ImageInput::create(std::string(plugin));
    if (input && input->open(path, spec, wishes)) return std::make_unique<OiioFile>(std::move(input), pages);
    reason = input ? input->geterror() : OIIO::geterror();
    return nullptr;
  }
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
